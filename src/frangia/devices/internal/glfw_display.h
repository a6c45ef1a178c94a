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
  std::string monitor;                    ///< its name or its number from 0; empty: the last one
  double delay_s = 0.05;                  ///< from the swap until the projector shows it
  std::optional<ResponseCurve> response;  ///< of the projector, to be undone
};

/// A projector that hangs on this machine as a monitor: a borderless full-screen window, pixel by
/// pixel. Defined where GLFW was there to build with; used from the main thread only.
///
/// errors   Error(Device) when there is no such monitor, no screen at all, or it scales pictures
[[nodiscard]] std::unique_ptr<PatternDisplay> open_glfw_display(const GlfwSettings& settings);

[[nodiscard]] std::vector<FoundDevice> find_glfw_monitors();

/// The driver "monitor".
[[nodiscard]] Driver glfw_driver();

}  // namespace frangia
