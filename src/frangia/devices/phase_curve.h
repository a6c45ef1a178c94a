#pragma once

#include <string>
#include <vector>

#include "frangia/devices/device_settings.h"

namespace frangia {

/// The phase that a phase shifter makes of its command, as measured: `frangia calibrate piezo`
/// finds it. Between its points it is straight.
struct PhaseCurve {
  std::vector<double> commands;    ///< rising; volts, or whatever the shifter takes
  std::vector<double> phases_rad;  ///< rising or falling, at those commands

  /// errors   Error(Input) unless there are two points or more, commands rising, phases monotonous
  void check(const std::string& whose) const;

  /// The phase at a command. units rad; clamped to the ends
  [[nodiscard]] double phase_at(double command) const;

  /// The command for a phase; one beyond the ends is brought into them by whole turns where that
  /// helps.
  /// errors   Error(Input) when the curve does not span this phase: its range is less than a turn
  [[nodiscard]] double command_for(double phase_rad) const;
};

/// The curve that a phase shifter's settings give: `curve_commands` with `curve_phases_deg`, or
/// `command_per_turn` for a straight one from `min_command` to `max_command`.
///
/// errors   Error(Input) that names file and key
[[nodiscard]] PhaseCurve read_phase_curve(DeviceSettings& settings,
                                          double min_command,
                                          double max_command);

}  // namespace frangia
