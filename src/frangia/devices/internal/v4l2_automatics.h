#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frangia/devices/internal/v4l2_system.h"

namespace frangia {

/// A control of a webcam and the value that it had.
struct V4l2Control {
  std::uint32_t id = 0;
  int value = 0;
};

/// What switching off the automatic functions of a webcam has changed.
struct V4l2Automatics {
  std::vector<V4l2Control> before;    ///< values to restore, in the order of their change
  std::vector<std::string> warnings;  ///< what stays automatic, and what stays changed
};

/// Switches off what makes frames of one scene differ: automatic exposure and its priority over the
/// frame rate, gain, white balance and focus, backlight compensation and the filter against the
/// flicker of lamps. A control that the camera does not have is passed over; one that it does not
/// change is named.
///
/// @source   Linux media documentation, "User controls" and "Camera controls"
[[nodiscard]] V4l2Automatics switch_off_automatics(V4l2System& system, int file);

/// The value of a control; false when the camera does not have it.
[[nodiscard]] bool get_control(V4l2System& system, int file, V4l2Control& control);

/// Gives controls the values that they had, the last one first. Failures are ignored: the camera
/// may be unplugged.
void restore_controls(V4l2System& system,
                      int file,
                      const std::vector<V4l2Control>& before) noexcept;

}  // namespace frangia
