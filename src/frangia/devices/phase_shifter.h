#pragma once

#include <string>

#include "frangia/devices/device.h"
#include "frangia/devices/phase_curve.h"

namespace frangia {

/// What a phase shifter is; does not change while it is open.
struct ShifterInfo {
  std::string unit = "V";  ///< of its command
  double min_command = 0.0;
  double max_command = 0.0;
  PhaseCurve curve;                 ///< phase over command, from the rig's settings
  double fringes_per_degree = 0.0;  ///< of the fringes it shifts; 0: as the pattern says
};

/// Moves one mirror of the interferometer, and with it the fringes: a piezo and its amplifier.
///
/// Phase to command, the approach from the same side and the correction of steps are the session's
/// work (see `PhaseShiftController`): a driver only brings its command to the device.
class PhaseShifter : public Device {
 public:
  [[nodiscard]] virtual const ShifterInfo& info() const = 0;

  /// Brings out a command and returns when it has settled.
  /// errors   Error(Device) when it is outside of the range or has not settled by the deadline
  virtual void drive(double command, const Deadline& deadline) = 0;

  /// Sets the pitch of the fringes, for interferometers that can; others accept only their own.
  /// errors   Error(Device) when it is another than `info().fringes_per_degree`
  virtual void set_fringe_frequency(double fringes_per_degree, const Deadline& deadline);

 protected:
  /// errors   Error(Device) when the command is outside of the range
  void check_command(double command) const;
};

}  // namespace frangia
