#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/registration/explain/internal/pose_hypotheses.h"
#include "frangia/registration/explain/internal/pose_sums.h"

namespace frangia {

/// Motions of the points of a view by changes of 1 mm: rotations about the part's centre by an arc
/// of 1 mm, then shifts, along the axes of the table that it stands on.
[[nodiscard]] Eigen::Matrix<double, 6, 6> motions_of_part(const PoseSetting& setting,
                                                          std::size_t view);

/// The motions of the views by the own changes of a cause, each by 1 mm or by its prior.
///
/// @shape    `at`: the views of the cause, as `PoseExplanation` has them; `profile`: of a drift
[[nodiscard]] Eigen::MatrixXd unit_motions(PoseCause cause,
                                           const std::vector<std::size_t>& at,
                                           const PoseSetting& setting,
                                           Eigen::Index unknowns,
                                           std::size_t profile = 0);

/// How the points of the views move with further changes of a rig that has changed already.
///
/// @shape    `at`, `basis`: as `changes_of_views`
[[nodiscard]] RigChanges rig_changes(const DriftModel& model,
                                     const Pattern& pattern,
                                     const SurfelLists& surfels,
                                     const Eigen::MatrixXd& basis,
                                     const Eigen::VectorXd& at);

/// The rig of each view after such changes.
[[nodiscard]] std::vector<Rig> rigs_of_views(const DriftModel& model,
                                             const Eigen::MatrixXd& basis,
                                             const Eigen::VectorXd& at);

/// Moves all surfels to where the rig of their view measures them, instead of the stated one.
void displace_views(std::vector<SurfelMap>& maps,
                    const Rig& stated,
                    const std::vector<Rig>& rigs,
                    const Pattern& pattern);

}  // namespace frangia
