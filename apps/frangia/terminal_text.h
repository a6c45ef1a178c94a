#pragma once

#include <string>
#include <string_view>

namespace frangia {

/// A text that can be printed on a terminal as part of one line. Control characters, bytes that are
/// not UTF-8, and the invisible characters that reorder a line are replaced by their codes: \n,
/// \x1b, \u202e. All text that may come from a file, a device or the command line is printed
/// through this function.
[[nodiscard]] std::string terminal_text(std::string_view text);

}  // namespace frangia
