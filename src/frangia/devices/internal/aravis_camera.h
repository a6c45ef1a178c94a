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

/// A camera by Aravis, waiting for its software trigger. Defined where Aravis was there to build
/// with.
///
/// errors   Error(Device) when there is none, it is in use, or does not do the format or region
[[nodiscard]] std::unique_ptr<CameraDevice> open_aravis_camera(const AravisSettings& settings,
                                                               const Deadline& deadline);

[[nodiscard]] std::vector<FoundDevice> find_aravis_cameras(const Deadline& deadline);

}  // namespace frangia
