#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/devices/driver.h"
#include "frangia/devices/internal/v4l2_system.h"

namespace frangia {

/// A pixel format of V4L2 cameras that the driver reads.
struct V4l2Format {
  std::string_view name;    ///< in rig.toml
  unsigned code = 0;        ///< V4L2_PIX_FMT_...
  std::string_view people;  ///< as people write it
};

/// All of them, the least compressed first: compression costs accuracy.
[[nodiscard]] const std::vector<V4l2Format>& v4l2_formats();

/// One way in which a camera delivers images.
struct V4l2Mode {
  V4l2Format format;
  int width_px = 0;   ///< of the images
  int height_px = 0;  ///< of the images
  double fps = 0.0;   ///< images per second; 0: the camera does not say
};

/// What an open camera says that it can deliver, by format, the largest image and the highest rate
/// first; empty where it does not say. Sizes in steps give their largest one.
[[nodiscard]] std::vector<V4l2Mode> v4l2_modes(V4l2System& system, int file);

/// The same as people and rig.toml state them: `size_px`, `pixel_format`, `frames_per_s`.
[[nodiscard]] std::vector<DeviceMode> device_modes(const std::vector<V4l2Mode>& modes);

}  // namespace frangia
