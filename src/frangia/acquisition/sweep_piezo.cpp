#include "frangia/acquisition/sweep_piezo.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/phase/algorithm/estimate_shifts.h"
#include "frangia/phase/wrap/estimate_noise.h"

namespace frangia {
namespace {

/// The commands as shifts of a pattern, by the shifter's current curve.
Pattern pattern_of(const ShifterInfo& info, const SweepOptions& options) {
  Pattern pattern{.name = "sweep"};
  pattern.fringes_per_degree =
      info.fringes_per_degree > 0.0 ? info.fringes_per_degree : options.fringes_per_degree;
  for (int i = 0; i < options.steps; ++i) {
    const double share = static_cast<double>(i) / (options.steps - 1);
    const double command = info.min_command + share * (info.max_command - info.min_command);
    pattern.shifts_rad.push_back(info.curve.phase_at(command) -
                                 info.curve.phase_at(info.min_command));
  }
  return pattern;
}

FrameStack take_sweep(RigDevices& devices,
                      const Rig& rig,
                      const SweepOptions& options,
                      const Run& run) {
  const ShifterInfo& info = devices.shifter->info();
  FrameStack stack{pattern_of(info, options), {}, rig.reference().white_level};
  CaptureDevices session(devices, rig, options.capture, run);
  session.expose_for(options.capture.camera.exposure_ms);
  session.begin_set(stack.pattern, 1.0);
  session.light_fringes();
  for (int i = 0; i < options.steps; ++i) {
    run.report(static_cast<double>(i) / options.steps);
    const double share = static_cast<double>(i) / (options.steps - 1);
    devices.shifter->drive(info.min_command + share * (info.max_command - info.min_command),
                           Deadline::in(options.capture.timeout_s, run.stop));
    stack.frames.push_back(session.capture({0, stack.pattern.name, i, 0, 0}).frame);
  }
  return stack;
}

}  // namespace

PiezoSweep sweep_piezo(RigDevices& devices,
                       const Rig& rig,
                       const SweepOptions& options,
                       const Run& run) {
  require(
      devices.reference() != nullptr && devices.shifter,
      "calibrating a piezo needs [devices.camera] and a phase shifter in [devices.fringes]; add "
      "them to rig.toml");
  require(options.steps >= 6, "`steps` must be at least 6");
  const SafeStateGuard safe(devices);
  const FrameStack stack = take_sweep(devices, rig, options, run);
  const NoiseModel noise =
      rig.reference().noise ? *rig.reference().noise : estimate_noise({&stack, 1});
  const ShiftEstimate found = estimate_shifts(stack, noise);
  PiezoSweep sweep;
  sweep.residual_ratio =
      found.expected_counts2 > 0.0 ? found.residual_counts2 / found.expected_counts2 : 0.0;
  if (!found.found) {
    throw Error(
        ErrorKind::Numeric,
        fmt::format("{}: no phase steps fit the frames of the sweep (residual variance {:.1f} "
                    "times the noise); keep the rig still, light the part evenly, or correct "
                    "command_per_turn",
                    devices.shifter->name(),
                    sweep.residual_ratio));
  }
  const ShifterInfo& info = devices.shifter->info();
  for (int i = 0; i < options.steps; ++i) {
    const double share = static_cast<double>(i) / (options.steps - 1);
    sweep.curve.commands.push_back(info.min_command +
                                   share * (info.max_command - info.min_command));
    sweep.curve.phases_rad.push_back(found.shifts_rad[static_cast<std::size_t>(i)] -
                                     found.shifts_rad.front());
  }
  sweep.curve.check(devices.shifter->name());
  return sweep;
}

}  // namespace frangia
