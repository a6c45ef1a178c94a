#include <cstring>

#include <fmt/format.h>
#include <linux/videodev2.h>

#include "frangia/devices/internal/v4l2_camera.h"
#include "frangia/devices/internal/v4l2_system.h"

namespace frangia {
namespace {

/// The pixel format that the settings choose; 0 where they leave that to the camera.
unsigned format_of(DeviceSettings& settings) {
  const std::string wanted = settings.text_or("pixel_format", "");
  if (wanted.empty()) return 0;
  for (const V4l2Format& format : v4l2_formats())
    if (wanted == format.name) return format.code;
  settings.fail("pixel_format", "must be grey, yuyv, mjpeg or jpeg");
}

}  // namespace

std::vector<FoundDevice> find_v4l2_cameras(V4l2System& system) {
  std::vector<FoundDevice> found;
  constexpr int kMost = 64;
  for (int i = 0; i < kMost; ++i) {
    const std::string path = fmt::format("/dev/video{}", i);
    const int file = system.open(path.c_str());
    if (file < 0) continue;
    v4l2_capability capability;
    std::memset(&capability, 0, sizeof capability);
    const bool is_camera = system.ioctl(file, VIDIOC_QUERYCAP, &capability) >= 0 &&
                           (capability.device_caps & V4L2_CAP_VIDEO_CAPTURE) != 0;
    const std::vector<V4l2Mode> modes =
        is_camera ? v4l2_modes(system, file) : std::vector<V4l2Mode>{};
    system.close(file);
    if (!is_camera) continue;
    found.push_back(
        {fmt::format("{} at {}", reinterpret_cast<const char*>(capability.card), path),  // NOLINT
         fmt::format("driver = \"v4l2\"\npath = \"{}\"\n", path),
         device_modes(modes)});
  }
  return found;
}

Driver v4l2_driver() {
  Driver driver;
  driver.name = "v4l2";
  driver.kind = DeviceKind::Camera;
  driver.description = "webcams through Video4Linux2";
  driver.open =
      [](DeviceSettings& settings, const Rig& rig, const Deadline&) -> std::unique_ptr<Device> {
    V4l2Settings camera;
    camera.path = settings.text_or("path", camera.path);
    camera.skip_frames = settings.integer_or("skip_frames", camera.skip_frames, 0, 30);
    const CameraModel& model = rig.reference().model;
    const std::vector<double> size = settings.numbers_or(
        "size_px", {static_cast<double>(model.width_px), static_cast<double>(model.height_px)});
    constexpr double kMostPixels = 16384.0;
    if (size.size() != 2 || !(size[0] >= 0.0 && size[0] <= kMostPixels) ||
        !(size[1] >= 0.0 && size[1] <= kMostPixels))
      settings.fail("size_px", "must be [width, height] in whole pixels");
    camera.width_px = static_cast<int>(size[0]);
    camera.height_px = static_cast<int>(size[1]);
    camera.format = format_of(settings);
    camera.fps = settings.number_or("frames_per_s", 0.0, 0.0, 10'000.0);
    return open_v4l2_camera(camera, kernel_v4l2());
  };
  driver.find = [](const Deadline&) { return find_v4l2_cameras(*kernel_v4l2()); };
  driver.choices.push_back({.key = "pixel_format", .values = {}});
  for (const V4l2Format& format : v4l2_formats())
    driver.choices.back().values.emplace_back(format.name);
  return driver;
}

}  // namespace frangia
