#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/camera_device.h"
#include "frangia/devices/driver.h"

namespace frangia {

struct AravisSettings {
  std::string id;  ///< name, serial number or address; empty: the first camera found
  std::string pixel_format = "Mono8";
  std::array<int, 4> region_px = {0, 0, 0, 0};  ///< x, y, width, height; width 0: the whole sensor
};

/// Opens a camera with Aravis, set to software trigger. Only defined in builds with Aravis.
///
/// @errors   Error(Device) when the camera does not exist, is in use, or does not support the
///          format or region
[[nodiscard]] std::unique_ptr<CameraDevice> open_aravis_camera(const AravisSettings& settings,
                                                               const Deadline& deadline);

[[nodiscard]] std::vector<FoundDevice> find_aravis_cameras(const Deadline& deadline);

}  // namespace frangia
