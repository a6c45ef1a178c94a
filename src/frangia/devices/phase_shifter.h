#pragma once

#include <string>
#include <vector>

#include "frangia/devices/device.h"
#include "frangia/devices/device_settings.h"

namespace frangia {

/// Measured phase of a phase shifter as a function of its command, interpolated linearly. The phase
/// shifter calibration determines it.
struct PhaseCurve {
  std::vector<double> commands;    ///< rising; in the unit of the shifter
  std::vector<double> phases_rad;  ///< monotonic, one per command

  /// @errors   Error(Input) unless there are at least two points with rising commands and monotonic
  ///          phases
  void check(const std::string& whose) const;

  /// The phase at a command, clamped to the ends of the curve.
  ///
  /// @units    rad
  [[nodiscard]] double phase_at(double command) const;

  /// The command for a phase. A phase beyond the ends is shifted by whole turns where that brings
  /// it into the curve.
  ///
  /// @units    rad
  /// @errors   Error(Input) when the curve does not contain the phase modulo a turn
  [[nodiscard]] double command_for(double phase_rad) const;
};

/// The curve in the settings of a phase shifter: `curve_commands` with `curve_phases_deg`, or
/// `command_per_turn` for a linear one from `min_command` to `max_command`.
///
/// @errors   Error(Input) that names the file and the key
[[nodiscard]] PhaseCurve read_phase_curve(DeviceSettings& settings,
                                          double min_command,
                                          double max_command);

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

/// Sets phase shifts through a phase shifter with its curve and a correction factor from the
/// measured shifts. Approaches every command from below to avoid hysteresis.
class PhaseShiftController {
 public:
  /// `shifter` must outlive the controller.
  explicit PhaseShiftController(PhaseShifter& shifter) : shifter_(shifter) {}

  /// Drives to the lowest command, where every set of frames starts.
  void return_to_start(const Deadline& deadline);

  /// Drives to a shift from the phase at rest; from rest when the shift is below the previous one.
  ///
  /// @units    rad
  /// @errors   Error(Device) as the shifter; Error(Input) when its curve does not contain the shift
  void shift_to(double shift_rad, const Deadline& deadline);

  /// Sets the factor on all requested shifts; initially 1.
  [[nodiscard]] double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }  ///< see `scale`

 private:
  PhaseShifter& shifter_;
  double scale_ = 1.0;
  double command_ = 0.0;
  bool started_ = false;
};

}  // namespace frangia
