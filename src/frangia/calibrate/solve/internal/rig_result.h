#pragma once

#include <span>

#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Adds the models and poses of all devices, the poses of the board and its shape to a solution.
/// The sizes are those of the known rig.
void add_devices(const Rig& known, const RigParameters& parameters, RigSolution& solution);

/// Adds the residuals of all devices and their summaries. `add_devices` comes first.
void add_residuals(std::span<const RigObservation> observations,
                   std::span<const BoardView> views,
                   const RigParameters& parameters,
                   const RigNoise& noise,
                   RigSolution& solution);

}  // namespace frangia
