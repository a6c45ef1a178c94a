#pragma once

#include <functional>
#include <string>

namespace frangia {

/// Replaces option names as the library writes them by flags as the user types them:
/// "set `keep_raw`" becomes "set --keep-raw", and "`voxel_mm`" becomes "--voxel". Only a lower-case
/// snake_case word between backticks is an option name; `frangia scan` and `rig.toml` stay as they
/// are.
/// A flag for which `has_flag` is false stays the name as it is, which a key of a file has as well.
[[nodiscard]] std::string with_flags(const std::string& sentence,
                                     const std::function<bool(const std::string&)>& has_flag = {});

}  // namespace frangia
