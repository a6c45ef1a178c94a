#pragma once

#include <string>

namespace frangia {

/// Replaces option names as the library writes them by flags as the user types them:
/// "set `keep_raw`" becomes "set --keep-raw", and "`voxel_mm`" becomes "--voxel". Only a lower-case
/// snake_case word between backticks is an option name; `frangia scan` and `rig.toml` stay as they
/// are.
[[nodiscard]] std::string with_flags(const std::string& sentence);

}  // namespace frangia
