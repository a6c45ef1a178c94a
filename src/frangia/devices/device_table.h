#pragma once

#include <filesystem>
#include <string>

#include "frangia/devices/device_settings.h"

namespace frangia {

/// Parses the lines of one `[devices.NAME]` table, such as those of `FoundDevice::settings`,
/// without its heading. `file` and `device` are for messages and relative paths, as in
/// DeviceSettings.
///
/// @errors   Error(Input) that names the file and the key: no TOML, a table within, an unsupported
///           type of value
[[nodiscard]] DeviceSettings parse_device_table(const std::string& lines,
                                                const std::filesystem::path& file,
                                                const std::string& device);

/// Returns the lines of a table, without its heading, `driver` first; parse_device_table restores
/// the same settings.
[[nodiscard]] std::string device_table_lines(const DeviceSettings& settings);

}  // namespace frangia
