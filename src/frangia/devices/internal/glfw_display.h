#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frangia/devices/driver.h"
#include "frangia/devices/pattern_display.h"
#include "frangia/rig/response_curve.h"

namespace frangia {

struct GlfwSettings {
  std::string monitor;    ///< name or number from 0; empty: the last monitor
  double delay_s = 0.05;  ///< from the buffer swap until the projector shows the image
  std::optional<ResponseCurve> response;  ///< of the projector, which the display compensates
};

/// Opens a borderless full-screen window on a monitor of this machine, pixel by pixel. Only defined
/// in builds with GLFW; use it from the main thread only.
///
/// @errors   Error(Device) when the monitor does not exist, when there is no screen, or when the
///          desktop scales images
[[nodiscard]] std::unique_ptr<PatternDisplay> open_glfw_display(const GlfwSettings& settings);

[[nodiscard]] std::vector<FoundDevice> find_glfw_monitors();

/// The driver "monitor".
[[nodiscard]] Driver glfw_driver();

}  // namespace frangia
