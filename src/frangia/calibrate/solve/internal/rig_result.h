#pragma once

#include <span>
#include <vector>

#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A solution with the models and poses of all devices, the poses of the board and its shape. The
/// sizes are those of the known rig.
[[nodiscard]] RigSolution solution_of(const Rig& known, const RigParameters& parameters);

/// The cameras of a solution with their residuals and the summaries of these.
[[nodiscard]] std::vector<SolvedCamera> with_residuals(std::vector<SolvedCamera> cameras,
                                                       std::span<const RigObservation> observations,
                                                       std::span<const BoardView> views,
                                                       const RigParameters& parameters,
                                                       const RigNoise& noise);

}  // namespace frangia
