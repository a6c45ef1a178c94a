#pragma once

#include "frangia/devices/device.h"

namespace frangia {

/// What turns the table. Motion is disabled when it is opened. Angles are right-handed about the
/// table's axis; the driver knows steps, direction, backlash and limits.
class TableDriver : public Device {
 public:
  /// Lets it move, or drops the motors' current where that can be done.
  virtual void enable(bool on, Deadline deadline) = 0;

  /// Makes the angle known: 0 here or at a switch. After an alarm it must be called before a move.
  virtual void home(Deadline deadline) = 0;

  /// Turns to an angle, always arriving from the same side, and returns at standstill.
  ///
  /// errors   DeviceError(Refused) out of limits, which the sentence gives in degrees; (Silent)
  /// when
  ///          it does not arrive in time; (Alarm) when the angle is no longer known
  virtual void move_to(double angle_rad, Deadline deadline) = 0;
};

}  // namespace frangia
