#pragma once

#include <string>
#include <string_view>

namespace frangia {

/// The text of a file as the readers take it: without a byte order mark, UTF-16 with or without one
/// as UTF-8 where it is ASCII ('?' for other letters), line ends of old Macs (CR alone) as LF, and
/// without zeros and Ctrl-Z at the end, as programs that write whole blocks leave them.
[[nodiscard]] std::string plain_text(std::string bytes);

/// Whether a file begins as text in UTF-16.
[[nodiscard]] bool is_utf16(std::string_view bytes);

}  // namespace frangia
