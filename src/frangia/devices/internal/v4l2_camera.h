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
  int width_px = 0;     ///< 0: the largest that the camera lists
  int height_px = 0;    ///< as the width
  unsigned format = 0;  ///< V4L2_PIX_FMT_...; 0: the least compressed one of the size
  double fps = 0.0;     ///< images per second; 0: as the camera likes
  int skip_frames = 1;  ///< frames in the pipeline of the camera at a request
};

/// Opens a webcam with Video4Linux2 in a grey or YUYV format, or else in Motion JPEG; the luminance
/// is used. The quality of the compression is read from a frame when it is opened; a later frame of
/// much lower quality counts as incomplete.
/// Webcams have no trigger: frames exposed before the request are discarded by their time stamps.
///
/// @errors   Error(Device) when the camera does not exist, is in use, or does not support the size
///          or a format
[[nodiscard]] std::unique_ptr<CameraDevice> open_v4l2_camera(const V4l2Settings& settings,
                                                             std::shared_ptr<V4l2System> system);

/// Lists the cameras among /dev/video*.
[[nodiscard]] std::vector<FoundDevice> find_v4l2_cameras(V4l2System& system);

/// The driver "v4l2".
[[nodiscard]] Driver v4l2_driver();

}  // namespace frangia
