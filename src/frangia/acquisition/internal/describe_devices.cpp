#include "frangia/acquisition/internal/describe_devices.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {
namespace {

/// Keys that may change between sessions: the operating system may renumber ports and monitors
/// after a restart, and a user who resumes after a fault may have slowed the table down or given it
/// more time to home. docs/devices.md lists all keys.
constexpr std::array<std::string_view, 23> kMayChange = {"port",
                                                         "baud",
                                                         "parity",
                                                         "stop_bits",
                                                         "host",
                                                         "tcp_port",
                                                         "path",
                                                         "monitor",
                                                         "boot_s",
                                                         "settle_s",
                                                         "delay_s",
                                                         "speed_deg_per_s",
                                                         "min_deg",
                                                         "max_deg",
                                                         "start_deg",
                                                         "faults",
                                                         "real_time",
                                                         "skip_frames",
                                                         "gpib_address",
                                                         "identify",
                                                         "end",
                                                         "home_time_s",
                                                         "exposure_step_ms"};

std::string text_of_value(const SettingValue& value) {
  return std::visit([](const auto& held) { return fmt::format("{}", held); }, value);
}

}  // namespace

std::string describe_devices(const std::vector<DeviceSettings>& devices) {
  std::string text;
  for (const DeviceSettings& device : devices) {
    text += fmt::format("[{}]\n", device.device());
    for (const auto& [key, value] : device.values()) {
      if (std::find(kMayChange.begin(), kMayChange.end(), key) == kMayChange.end())
        text += fmt::format("{} = {}\n", key, text_of_value(value));
    }
  }
  return text;
}

}  // namespace frangia
