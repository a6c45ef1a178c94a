#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/registration/view_group.h"

namespace frangia {

/// When groups count as joined. Nothing is joined on a guess: what fits in two places stays apart.
struct JoinByShapeOptions {
  double spacing_mm = 1.0;         ///< of the groups' points
  double min_overlap = 0.12;       ///< share of the smaller group's points
  double max_violation = 0.015;    ///< of the points compared, that the other saw through
  double max_runner_up = 0.85;     ///< what fits elsewhere, as a share of what fits here
  double min_eigenvalue = 0.0002;  ///< less, and one slides or turns on the other; what slides a
                                   ///< little less freely is told by fitting beside, too
  double max_residual = 3.0;       ///< median distance, as a multiple of that where groups fit best
  /// Of two views that look the same from the same place only the first is joined: either the part
  /// was not moved, or it looks alike from two sides, and nothing tells which.
  bool leave_out_duplicates = false;
};

/// Two clusters of groups that were put together.
struct GroupJoin {
  std::size_t from = 0;
  std::size_t to = 0;
  GroupFit fit;
};

struct JoinedGroups {
  std::size_t reference = 0;  ///< the group whose frame all have: the first of the largest cluster
  std::vector<std::optional<Eigen::Isometry3d>>
      reference_from_group;     ///< none: could not be joined
  std::vector<bool> ambiguous;  ///< fits in more than one place, as far as others are joined
  std::vector<std::optional<std::size_t>>
      duplicate_of;  ///< the view that looks the same, if left out
  std::vector<GroupJoin> joins;
};

/// Finds how groups of views fit together from their shape alone.
///
/// Features are matched for every two groups, motions that many matches agree on are refined and
/// checked by what either group's views saw; the best is joined first, and the joined are checked
/// together from then on. The same for any number of threads.
[[nodiscard]] JoinedGroups join_by_shape(std::span<const ViewGroup> groups,
                                         const GroupViews& views,
                                         const JoinByShapeOptions& options,
                                         const Run& run = {});

}  // namespace frangia
