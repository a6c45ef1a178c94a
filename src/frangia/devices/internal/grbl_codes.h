#pragma once

#include <string>

namespace frangia {

/// "ALARM:1, a limit switch was hit" for the line "ALARM:1" of GRBL.
///
/// @source   github.com/gnea/grbl/wiki, Grbl v1.1 Interface
[[nodiscard]] std::string explained_alarm(const std::string& line);

/// "(error:20): the command is unknown" for the line "error:20" of GRBL.
[[nodiscard]] std::string explained_error(const std::string& line);

}  // namespace frangia
