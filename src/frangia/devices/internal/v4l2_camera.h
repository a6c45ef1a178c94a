#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/camera_device.h"
#include "frangia/devices/driver.h"
#include "frangia/devices/internal/v4l2_system.h"

namespace frangia {

struct V4l2Settings {
  std::string path = "/dev/video0";
  int width_px = 0;  ///< wanted; the rig's
  int height_px = 0;
  int skip_frames = 1;  ///< that the camera has under way when a frame is asked for
};

/// A webcam of Linux' Video4Linux2: grey, or the brightness of its YUYV pictures. It has no
/// trigger: frames that were under way when one is asked for are thrown away, by their time stamps.
///
/// errors   Error(Device) when there is none, it is in use, or does not do the size or a format
[[nodiscard]] std::unique_ptr<CameraDevice> open_v4l2_camera(const V4l2Settings& settings,
                                                             std::shared_ptr<V4l2System> system);

/// The cameras among /dev/video*.
[[nodiscard]] std::vector<FoundDevice> find_v4l2_cameras(V4l2System& system);

/// The driver "v4l2".
[[nodiscard]] Driver v4l2_driver();

}  // namespace frangia
