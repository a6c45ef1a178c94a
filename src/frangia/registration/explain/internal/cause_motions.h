#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/registration/explain/internal/pose_hypotheses.h"

namespace frangia {

/// Motions of points by changes of 1 mm: rotations about the part's centre by an arc of 1 mm, then
/// shifts.
[[nodiscard]] Eigen::Matrix<double, 6, 6> motions_of_part(const PoseSetting& setting);

/// The motions of the views by the own changes of a cause, each by 1 mm or by its prior.
///
/// @shape    `at`: the views of the cause, as `PoseExplanation` has them; `profile`: of a drift
[[nodiscard]] Eigen::MatrixXd unit_motions(PoseCause cause,
                                           const std::vector<std::size_t>& at,
                                           const PoseSetting& setting,
                                           Eigen::Index unknowns,
                                           std::size_t profile = 0);

}  // namespace frangia
