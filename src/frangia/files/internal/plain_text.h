#pragma once

#include <string>

namespace frangia {

/// The text of a file as the readers take it: without a byte order mark, UTF-16 as UTF-8 where it
/// is ASCII ('?' for other letters), and line ends of old Macs (CR alone) as LF.
[[nodiscard]] std::string plain_text(std::string bytes);

}  // namespace frangia
