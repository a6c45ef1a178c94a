#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// Steps, fringe pitch and capture settings of a sweep over a phase shifter's commands.
struct SweepOptions {
  int steps = 25;                   ///< commands, evenly over the shifter's range
  double fringes_per_degree = 1.0;  ///< for an interferometer with adjustable pitch
  CaptureOptions capture;           ///< exposure, attempts, timeouts
};

/// Result of a sweep over a phase shifter's commands.
struct PiezoSweep {
  PhaseCurve curve;  ///< phase over command, 0 at the first one
  double residual_ratio =
      0.0;  ///< residual variance of the fit over the variance of the camera's noise
};

/// Measures the curve of phase over command of a phase shifter: drives it from the lowest command
/// to the highest, takes a frame at each step and estimates the phase steps from the frames alone.
///
/// The shifter's current curve is the initial guess. Its error from one step to the next must stay
/// below a few tenths of a fringe.
/// @source   advanced iterative algorithm (AIA), Wang and Han 2004
/// @errors   Error(Input) when the rig has no phase shifter, or for fewer than 6 steps;
///          Error(Numeric) when no phase steps fit the frames; Error(Device)
[[nodiscard]] PiezoSweep sweep_piezo(RigDevices& devices,
                                     const Rig& rig,
                                     const SweepOptions& options = {},
                                     const Run& run = {});

}  // namespace frangia
