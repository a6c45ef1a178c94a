#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {

/// Changes of one standard deviation that what is known of the poses leaves open, as columns of six
/// rows for each view: a rotation and a translation of its points.
struct PoseSpread {
  Eigen::MatrixXd columns;

  /// Without what all views have in common: it moves the surface as a whole, and no pair shows it.
  [[nodiscard]] ViewMotions of_views() const;
};

/// Returns where the causes beside the winner place the views instead, with what they leave open
/// themselves, each with the root of its probability, and what no cause explains: the winner leaves
/// that much between views, as shifts of each view by itself. What a cause changes of the rig
/// counts as the rigid motion that is nearest.
[[nodiscard]] PoseSpread spread_of_causes(const PoseRound& scored,
                                          const ScoredCause& winner,
                                          const Registration& work);

/// Returns what the changes of the winner leave open themselves.
///
/// @shape    `won`: of the winner, in the unknowns of `scored`, or of the views alone
[[nodiscard]] PoseSpread spread_of_winner(const PoseRound& scored,
                                          const PosePosterior& won,
                                          const Registration& work);

/// Returns how far the rig is from the one that measured the points by the causes that change it,
/// each with its probability, all through the scan: their changes and what these leave open. A
/// cause does not count whose effect on the views is below what pairs have in common, nor one that
/// wins without a noticeable effect. Unlike `spread_of_causes` it holds what such a rig does to the
/// shape of every view alike.
///
/// @shape    `applied`: the cause by whose rigs the points are measured; none: by the stated rig
[[nodiscard]] RigCovariance open_rig(const PoseRound& scored,
                                     const DriftModel& model,
                                     const std::optional<PoseCause>& applied);

/// Both together.
[[nodiscard]] PoseSpread operator+(const PoseSpread& one, const PoseSpread& other);

}  // namespace frangia
