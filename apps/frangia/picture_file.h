#pragma once

#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"

#include "check_can_write.h"

namespace frangia {

/// Checks before the work that a picture can be written after it.
///
/// @errors   Error(Input) when the extension is not .png; Error(File) when the folder does not
///          exist or is not writable
inline void check_picture_output(const std::filesystem::path& path) {
  if (lowercase_extension(path) != ".png") {
    throw Error(ErrorKind::Input,
                fmt::format("{}: pictures are written as PNG; use a name that ends in .png",
                            path.string()));
  }
  check_can_write(path);
}

}  // namespace frangia
