#pragma once

#include <string>
#include <vector>

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

}  // namespace frangia
