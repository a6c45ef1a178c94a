#pragma once

#include <limits>
#include <optional>

#include "frangia/devices/device.h"

namespace frangia {

struct TurntableInfo {
  bool can_home = false;  ///< else the angle at which it is enabled counts as 0
  double min_rad = -std::numeric_limits<double>::infinity();  ///< soft limits
  double max_rad = std::numeric_limits<double>::infinity();
};

/// A turntable. Angles count on over whole turns and are right-handed about its axis, whatever the
/// motor's own direction; the backlash approach is the driver's.
///
/// It starts disabled, its angle unknown. After an alarm, a stall or `make_safe` the angle is
/// unknown again until `home`: never a silent resume.
class TurntableDevice : public Device {
 public:
  [[nodiscard]] virtual const TurntableInfo& info() const = 0;

  /// Lets the motor hold and move, or lets go of it.
  virtual void enable(bool on, const Deadline& deadline) = 0;

  /// Finds angle 0: by its switch, or, without one, by taking the present place for it.
  /// errors   Error(Device) when it is not enabled or the switch is not met
  virtual void home(const Deadline& deadline) = 0;

  /// Where it stands; nothing when that is not known.
  [[nodiscard]] virtual std::optional<double> angle_rad() const = 0;

  /// Turns to an angle and returns at standstill.
  /// errors   Error(Device) when it is outside of the limits (before anything moves), disabled, its
  ///          angle unknown, or standstill is not reached by the deadline: then motion is stopped
  virtual void move_to(double angle_rad, const Deadline& deadline) = 0;
};

}  // namespace frangia
