#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/registration/internal/find_pose_hypotheses.h"
#include "frangia/registration/join_by_shape.h"

namespace frangia {

/// A pose of one group on another that may be right.
struct JoinCandidate {
  std::size_t to = 0;
  std::size_t from = 0;
  PoseHypothesis hypothesis;
};

/// The best pose hypotheses of every two groups, a few each.
[[nodiscard]] std::vector<JoinCandidate> find_join_candidates(std::span<const ViewGroup> groups,
                                                              const GroupViews& views,
                                                              const JoinByShapeOptions& options,
                                                              const Run& run);

/// Distance at which corresponding surfaces come to lie: the least residual of all candidates with
/// sufficient overlap and no violations. Infinite when there is none.
[[nodiscard]] double typical_residual_mm(std::span<const JoinCandidate> candidates,
                                         const JoinByShapeOptions& options);

/// Whether two groups of one view each show the same surface from the same viewpoint.
[[nodiscard]] bool are_duplicates(const ViewGroup& to,
                                  const ViewGroup& from,
                                  const PoseHypothesis& hypothesis);

}  // namespace frangia
