#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frangia/devices/driver.h"
#include "frangia/devices/pattern_display.h"
#include "frangia/rig/fringe_waveform.h"

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

/// How long each monitor shows its number.
inline constexpr double kIdentify_s = 4.0;

/// Shows on each monitor the number that `find_glfw_monitors` gives it. Only defined in builds with
/// GLFW.
///
/// @errors   Error(Device) as `open_glfw_display`
void identify_glfw_monitors(const Deadline& deadline);

/// The driver "monitor".
[[nodiscard]] Driver glfw_driver();

}  // namespace frangia
