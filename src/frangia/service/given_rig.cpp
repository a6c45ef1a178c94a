#include "frangia/service/given_rig.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/write_text_file.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/simulated_rig.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

bool is_plain_name(std::string_view name) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.:+@";
  return !name.empty() && name.front() != '.' &&
         name.find_first_not_of(kPlain) == std::string_view::npos;
}

/// Whether a text names a serial port or a video device, and cannot name a file.
bool is_device_node(std::string_view path) {
  constexpr std::array<std::string_view, 6> kPlaces = {"/dev/tty",
                                                       "/dev/video",
                                                       "/dev/serial/by-id/",
                                                       "/dev/serial/by-path/",
                                                       "/dev/v4l/by-id/",
                                                       "/dev/v4l/by-path/"};
  return std::any_of(kPlaces.begin(), kPlaces.end(), [&](std::string_view place) {
    return path.starts_with(place) && is_plain_name(path.substr(place.size()));
  });
}

std::string text_of(const SettingValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? std::string() : *text;
}

void check_setting(const DeviceSettings& device,
                   const std::string& key,
                   const SettingValue& value) {
  const std::string text = text_of(value);
  if (key == "folder")
    device.fail(key, "names a folder of this computer, which the app does not open for a browser");
  if (key == "part") {
    const auto parts = part_names();
    if (std::find(parts.begin(), parts.end(), text) == parts.end())
      device.fail(key, "must be a built-in part; the app opens no file for a browser");
  }
  if (key == "true_rig" && text != true_rig_beside("rig.toml").string())
    device.fail(key, "names a file of this computer, which the app does not open for a browser");
  if ((key == "port" || key == "path") && !is_device_node(text)) {
    device.fail(key,
                "must be a serial port or a video device, such as /dev/ttyUSB0 or /dev/video0");
  }
}

}  // namespace

void check_given_devices(std::span<const DeviceSettings> devices) {
  for (const DeviceSettings& device : devices) {
    for (const auto& [key, value] : device.values())
      check_setting(device, key, value);
  }
}

void write_given_rig(const ProjectFolder& project, const GivenRig& given) {
  const std::filesystem::path file = project.rig();
  const auto write = [](const std::filesystem::path& path, const std::string& text) {
    write_text_file(path, text);
  };
  write(file, given.rig);
  const Rig rig = read_rig(file, {}, RigContent::StartValues);  // opens no other file
  const std::vector<DeviceSettings> devices = read_device_settings(file);
  check_given_devices(devices);
  const std::string name = rig.calibration ? rig.calibration->covariance_file : std::string();
  if (name.empty()) return;
  if (!is_plain_name(name) || !name.ends_with(".csv") || name == file.filename()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: calibration.covariance must name a CSV file beside rig.toml",
                            file.filename().string()));
  }
  if (given.covariance.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("this rig.toml belongs to {}, which holds the uncertainty of its "
                            "calibration; choose both files together",
                            name));
  }
  write(file.parent_path() / name, given.covariance);
  static_cast<void>(read_rig(file));
}

}  // namespace frangia
