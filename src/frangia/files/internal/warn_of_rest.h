#pragma once

#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "frangia/core/run.h"

namespace frangia {

/// Warns of data behind what the header of a file counts; blanks and zeros do not matter.
inline void warn_of_rest(std::string_view rest, const std::filesystem::path& path, const Run& run) {
  constexpr std::string_view kBlank(" \t\r\n\v\f\0\x1A", 8);
  if (rest.find_first_not_of(kBlank) == std::string_view::npos) return;
  run.warn(
      fmt::format("{}: {} byte{} left out behind what its header counts; the header may be wrong",
                  path.string(),
                  rest.size(),
                  rest.size() == 1 ? " is" : "s are"));
}

}  // namespace frangia
