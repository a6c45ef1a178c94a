#include "frangia/devices/folder_camera.h"

#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "frangia/devices/device_error.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

class FolderCamera : public CameraDriver {
 public:
  explicit FolderCamera(const DeviceSettings& settings)
      : name_(settings.device_name()), folder_(settings.text("folder")) {
    if (!std::filesystem::is_directory(folder_)) {
      settings.fail("folder",
                    fmt::format("is \"{}\", but there is no such folder", folder_.string()));
    }
  }

  [[nodiscard]] std::string probe(Deadline /*deadline*/) override {
    return "frames from " + folder_.string();
  }
  void make_safe() noexcept override {}
  CameraSettings configure(const CameraSettings& settings, Deadline /*deadline*/) override {
    return settings_ = settings;
  }

  [[nodiscard]] CapturedFrame expose(const FrameId& id, Deadline /*deadline*/) override {
    const std::filesystem::path path =
        folder_ / fmt::format("views/{:03}/{}-{}.png", id.view, id.pattern, id.frame);
    if (!std::filesystem::exists(path)) {
      throw DeviceError(
          name_, DeviceFault::Silent, fmt::format("{} is missing; put it there", path.string()));
    }
    return {.frame = read_png(path), .settings = settings_, .number = ++number_};
  }

 private:
  std::string name_;
  std::filesystem::path folder_;
  CameraSettings settings_;
  std::uint64_t number_ = 0;
};

}  // namespace

void add_folder_camera(DriverRegistry& registry) {
  registry.cameras["folder"] = {"frames from a folder of PNG files",
                                [](const DeviceSettings& settings, const Rig&) {
                                  return std::make_unique<FolderCamera>(settings);
                                },
                                [] { return std::vector<std::string>{}; }};
}

}  // namespace frangia
