#pragma once

#include "frangia/devices/device.h"

namespace frangia {

/// What moves the fringes of an interferometer: a piezo behind its amplifier. It knows volts only;
/// a DriveCurve says which volts make which phase.
class PhaseShifter : public Device {
 public:
  struct Range {
    double low_v = 0.0;
    double high_v = 0.0;
  };
  /// What the actuator stands, from its settings or asked of the device when it was opened.
  [[nodiscard]] virtual Range range() const = 0;

  /// Drives to `volts` and returns once it has settled.
  ///
  /// errors   DeviceError(Refused) out of range, (Silent) when it does not settle in time
  virtual void drive(double volts, Deadline deadline) = 0;

  /// Goes to the low end, so that what follows is approached from below, as all sets are: a piezo's
  /// place depends on where it came from.
  virtual void rest(Deadline deadline) { drive(range().low_v, deadline); }
};

}  // namespace frangia
