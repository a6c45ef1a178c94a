#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/registration/explain/internal/pose_sums.h"

namespace frangia {

/// How points move with further changes of a rig that has changed already.
///
/// @shape    `at`, `basis`: as `changes_of_views`
[[nodiscard]] RigChanges rig_changes(const DriftModel& model,
                                     const Pattern& pattern,
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
