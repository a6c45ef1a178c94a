#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

struct SweepOptions {
  int steps = 25;                   ///< commands, evenly over the shifter's range
  double fringes_per_degree = 1.0;  ///< for an interferometer whose pitch is set
  CaptureOptions capture;           ///< exposure, attempts, patience
};

/// What a sweep over a phase shifter's commands showed.
struct PiezoSweep {
  PhaseCurve curve;  ///< phase over command, 0 at the first one
  double residual_ratio =
      0.0;  ///< variance that no phases explain, over that of the camera's noise
};

/// Drives a phase shifter from its lowest command to its highest, takes a frame at each, and finds
/// the phase of each from the frames alone (AIA): how its command becomes phase.
///
/// The curve that it has now is the first guess, and must not be off by more than some tenths of a
/// fringe from one step to the next.
/// errors   Error(Input) when the rig has no phase shifter, or fewer than six steps are asked for;
///          Error(Numeric) when no phases explain the frames; Error(Device)
[[nodiscard]] PiezoSweep sweep_piezo(RigDevices& devices,
                                     const Rig& rig,
                                     const SweepOptions& options = {},
                                     const Run& run = {});

}  // namespace frangia
