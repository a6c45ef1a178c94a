#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "frangia/registration/explain/internal/pose_hypotheses.h"

namespace frangia {

/// What moved between two views, as `profile` of a hypothesis of `PoseCause::RigMoved`.
enum class MovedRig : std::size_t {
  Projector,  ///< alone
  Camera,     ///< against projector and table, which it sees moving together
};
inline constexpr std::size_t kMovedRigs = 2;

/// Whether changes of the rig may differ from each view to the next, as those of a knock do.
[[nodiscard]] bool knows_each_view(const PoseSetting& setting);

/// Motions of the points of some views by motions of the table in the rig's frame, three rotations
/// about the camera and three shifts, then by the same motions of the projector, each by the unit
/// of the setting. Without a rig that changes, those of the table alone.
///
/// @shape    `shares`: of each view; unknowns x 12, or x 6
[[nodiscard]] Eigen::MatrixXd motions_in_rig(const PoseSetting& setting,
                                             const Eigen::VectorXd& shares,
                                             Eigen::Index unknowns);

/// What moved, in units of `motions_in_rig`: its own six motions, and a small share of all others,
/// since nothing moves exactly about itself.
///
/// @shape    12 x 18
[[nodiscard]] Eigen::MatrixXd motions_of_knock(MovedRig moved);

}  // namespace frangia
