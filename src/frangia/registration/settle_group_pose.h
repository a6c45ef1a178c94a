#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/registration/view_group.h"

namespace frangia {

/// A motion of one group along which it fits the other as well as it does without.
///
/// @units    mm, rad; the frame of the group that stays
struct OpenMotion {
  /// A rotation (rad) and a translation (mm) of one standard deviation, as in `ViewMotions`.
  Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
  double spread_mm = 0.0;  ///< root mean square way of the group's points by it
  bool turns = false;      ///< about `axis`; otherwise it slides along `axis`
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit

  [[nodiscard]] std::string words() const;  ///< "its turn about the axis (0.00, 0.00, 1.00)"
};

/// The pose of one group on another that their surfaces contradict least.
struct SettledPose {
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();  ///< from the group that was settled
  double moved_mm = 0.0;  ///< root mean square way of the group's points from where it started; 0:
                          ///< no pose contradicts less
  double log_odds = 0.0;  ///< of the pose over the start
  std::vector<OpenMotion> open;  ///< what the surfaces do not decide
  std::vector<OpenMotion> held;  ///< motions that the distances do not show, but contradictions do
};

/// Options of `settle_group_pose`.
struct SettleOptions {
  double spacing_mm = 0.0;  ///< of the points of the groups; required
  /// Standard deviation of the start along a motion that leaves the fit as it is, root mean square
  /// of the points; infinite: nothing is known.
  double prior_mm = std::numeric_limits<double>::infinity();
};

/// Settles what the fit of two groups leaves open: along each motion that hardly changes their
/// distances, such as the turn of a shaft about its axis, the group is moved all the way while the
/// rest is fitted again, and the contradictions are counted. A pose elsewhere that contradicts
/// less, at odds of 100 : 1 by that and by the prior, is taken; poses that are about as probable
/// are `open`.
///
/// @errors   Error(Input) without a spacing; Error(Cancelled)
[[nodiscard]] SettledPose settle_group_pose(const ViewGroup& to,
                                            const ViewGroup& from,
                                            const Eigen::Isometry3d& start,
                                            const GroupViews& views,
                                            const SettleOptions& options,
                                            const Run& run = {});

}  // namespace frangia
