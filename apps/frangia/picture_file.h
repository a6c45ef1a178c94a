#pragma once

#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/lowercase_extension.h"

namespace frangia {

/// errors   Error(Input) when a picture's name has another extension than .png
inline void check_picture_ending(const std::filesystem::path& path) {
  if (lowercase_extension(path) == ".png") return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: a picture is written as .png; name such a file", path.string()));
}

}  // namespace frangia
