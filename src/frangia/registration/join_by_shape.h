#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/registration/compare_groups.h"
#include "frangia/registration/view_group.h"

namespace frangia {

/// Conditions for a join. A pose that is ambiguous is never chosen: such groups stay apart.
struct JoinByShapeOptions {
  double spacing_mm = 0.0;         ///< of the groups' points; required
  double min_overlap = 0.12;       ///< share of the smaller group's points
  double max_violation = 0.015;    ///< share of the compared points that violate free space
  double max_runner_up = 0.85;     ///< score of the second-best pose, as a share of the best one's
  double runner_up_slack = 3.0;    ///< limits are this much wider for a second-best pose
  double min_eigenvalue = 0.0002;  ///< below, one group slides or turns on the other
  double well_constrained = 0.02;  ///< eigenvalue below which poses near the best one are tried
  double max_residual = 3.0;       ///< as a multiple of the residual of the best fits
  double feature_radius = 5.0;     ///< neighbourhood of a feature, in spacings
  std::size_t max_candidates = 6;  ///< poses for every two groups
  std::size_t max_starts = 30;     ///< poses that are refined for every two clusters
  /// Joins only the first of two views that show the same surface from the same viewpoint: either
  /// the part was not moved, or it looks alike from two sides and the two cannot be told apart.
  bool leave_out_duplicates = false;
  /// Joins groups whose shape determines all but a turn about one axis, as that of a round part:
  /// every turn fits where both were measured, and the joined pose has any of them. For groups
  /// that were measured all around; others could pile up on one side.
  bool may_turn = false;

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// Two clusters of groups that were joined.
struct GroupJoin {
  std::size_t from = 0;  ///< index of the cluster that moved; it becomes part of `to`
  std::size_t to = 0;    ///< index of the cluster that stayed
  GroupFit fit;          ///< fit in the pose of the join
};

/// The common frame of groups that were joined, and the groups that were not.
struct JoinedGroups {
  std::size_t reference = 0;  ///< the first group of the largest cluster, whose frame all poses use
  std::vector<std::optional<Eigen::Isometry3d>> reference_from_group;  ///< none: not joined
  std::vector<bool> ambiguous;                           ///< fits in more than one pose
  std::vector<std::optional<std::size_t>> duplicate_of;  ///< the duplicate view, if left out
  std::vector<GroupJoin> joins;                          ///< in the order in which they were made
};

/// Finds how groups of views fit together from their shape alone.
///
/// Matches features of every two groups, refines the motions that many matches agree on, and checks
/// them against free space. The best pose is joined first; joined groups are compared as one from
/// then on. The result does not depend on the number of threads.
///
/// @shape    results: one a group
/// @errors   Error(Input) as `JoinByShapeOptions::check`
[[nodiscard]] JoinedGroups join_by_shape(std::span<const ViewGroup> groups,
                                         const GroupViews& views,
                                         const JoinByShapeOptions& options,
                                         const Run& run = {});

}  // namespace frangia
