#pragma once

#include <cstddef>

#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/internal/explain_poses.h"

namespace frangia {

/// Whether a cause is corrected by other poses of the views.
[[nodiscard]] bool moves_views(PoseCause cause);

/// The poses by the winner, refined with many surfels, and what remains open of them.
///
/// @shape    `dense`: surfels of each view
[[nodiscard]] CorrectedPoses correct_poses(const PoseRound& scored,
                                           const ScoredCause& winner,
                                           const Registration& work,
                                           std::size_t dense);

}  // namespace frangia
