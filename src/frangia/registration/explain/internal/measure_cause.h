#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/internal/assess_fit.h"

namespace frangia {

/// The parameters of the rig that changed most, in standard deviations of their prior: from what is
/// stated, or by the way between the views.
///
/// @shape    `changes`: terms x views
[[nodiscard]] std::vector<std::string> terms_of(const DriftModel& model,
                                                const Eigen::MatrixXd& changes,
                                                bool drifts);

/// What a cause found, in numbers, the second best beside it, and those that move the views alike.
///
/// @shape    `first`: its index in the round's causes
[[nodiscard]] PoseExplanation explanation_by(const PoseRound& round,
                                             std::size_t first,
                                             const Registration& work);

}  // namespace frangia
