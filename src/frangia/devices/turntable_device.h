#pragma once

#include <limits>
#include <optional>

#include "frangia/devices/device.h"

namespace frangia {

/// Homing and travel limits of a turntable; constant while it is open.
struct TurntableInfo {
  bool can_home = false;  ///< false: the angle at which it is enabled is 0
  double min_rad = -std::numeric_limits<double>::infinity();  ///< soft limits
  double max_rad = std::numeric_limits<double>::infinity();   ///< infinite: no limit
};

/// A turntable. Angles accumulate over whole turns and are right-handed about its axis, whatever
/// the direction of the motor. The driver compensates backlash.
///
/// It starts disabled with an unknown angle. After an alarm, a stall or `make_safe` the angle is
/// unknown until `home`; motion never resumes silently.
class TurntableDevice : public Device {
 public:
  /// Properties of the open turntable.
  [[nodiscard]] virtual const TurntableInfo& info() const = 0;

  /// Enables or disables the motor.
  virtual void enable(bool on, const Deadline& deadline) = 0;

  /// Finds angle 0 with the home switch; without one, the present position becomes angle 0.
  ///
  /// @errors   Error(Device) when it is disabled or the switch is not reached
  virtual void home(const Deadline& deadline) = 0;

  /// Makes `angle_rad` the angle of the present position of a table without a home switch.
  ///
  /// @errors   Error(Device) when it is disabled, or has a home switch and does not support this
  virtual void set_angle(double angle_rad, const Deadline& deadline) {
    if (angle_rad != 0.0) fail_device(*this, "its angle cannot be set; home it");
    home(deadline);
  }

  /// The present angle; empty when it is unknown.
  [[nodiscard]] virtual std::optional<double> angle_rad() const = 0;

  /// Turns to an angle and returns at standstill.
  ///
  /// @errors   Error(Device) when the angle is out of the limits (before any motion), when the
  ///          table is disabled or its angle unknown, or when it is not at standstill by the
  ///          deadline, which stops the motion
  virtual void move_to(double angle_rad, const Deadline& deadline) = 0;

  /// Expected duration of a move to an angle from the present one, by the way and the speed; 0 when
  /// it is unknown. Callers derive the deadline of a move from it.
  [[nodiscard]] virtual double move_time_s(double /*angle_rad*/) const { return 0.0; }
  /// Expected duration of `home`; 0 when it is unknown.
  [[nodiscard]] virtual double home_time_s() const { return 0.0; }
};

}  // namespace frangia
