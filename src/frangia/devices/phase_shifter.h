#pragma once

#include <string>

#include "frangia/devices/device.h"
#include "frangia/devices/phase_curve.h"

namespace frangia {

/// Properties of a phase shifter; constant while it is open.
struct ShifterInfo {
  std::string unit = "V";           ///< of its command
  double min_command = 0.0;         ///< smallest command, in `unit`
  double max_command = 0.0;         ///< largest command, in `unit`
  PhaseCurve curve;                 ///< phase as a function of the command, from rig.toml
  double fringes_per_degree = 0.0;  ///< pitch of the fringes; 0: as the pattern states
};

/// Moves a mirror of the interferometer, and with it the fringes: a piezo and its amplifier.
///
/// A driver only sends commands to the device. `PhaseShiftController` converts phases to commands,
/// approaches them from below and corrects the steps.
class PhaseShifter : public Device {
 public:
  [[nodiscard]] virtual const ShifterInfo& info() const = 0;  ///< properties of the open shifter

  /// Sets the command and returns when it has settled.
  ///
  /// @errors   Error(Device) when it is out of range or has not settled by the deadline
  virtual void drive(double command, const Deadline& deadline) = 0;

  /// Sets the pitch of the fringes on interferometers with a variable pitch; others accept only
  /// their own.
  ///
  /// @errors   Error(Device) when it differs from `info().fringes_per_degree`
  virtual void set_fringe_frequency(double fringes_per_degree, const Deadline& deadline);

 protected:
  /// @errors   Error(Device) when the command is out of range
  void check_command(double command) const;
};

}  // namespace frangia
