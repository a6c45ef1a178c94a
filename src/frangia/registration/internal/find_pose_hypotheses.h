#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/compare_groups.h"
#include "frangia/registration/view_group.h"

namespace frangia {

/// Lengths of the pose search, as shares of the spacing of the groups' points.
struct PoseSearchScale {
  double spacing_mm = 0.0;

  /// Points of refined poses agree within this distance.
  [[nodiscard]] double gate_mm() const { return 0.3 * spacing_mm; }
  /// The same for poses that come from feature matches, whose error is about one spacing.
  [[nodiscard]] double coarse_gate_mm() const { return 1.2 * spacing_mm; }
  /// Poses that are nearer to each other count as one.
  [[nodiscard]] double distinct_mm() const { return 1.5 * spacing_mm; }
  /// Matched features may come to lie this far apart.
  [[nodiscard]] double match_tolerance_mm() const { return 1.5 * spacing_mm; }
};

/// A pose of one group on another that may be right.
struct PoseHypothesis {
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();
  GroupFit fit;

  /// Points that agree, less three times those that violate free space. A pose whose residual
  /// exceeds `typical_mm`, that of a good fit, scores less in proportion.
  [[nodiscard]] double score(double typical_mm) const;
};

/// A group and the features of its points.
struct DescribedGroup {
  const ViewGroup& group;
  const Eigen::MatrixXf& features;
};

/// Poses of one group on another from feature matches, refined; best first, at most eight.
[[nodiscard]] std::vector<PoseHypothesis> find_pose_hypotheses(const DescribedGroup& to,
                                                               const DescribedGroup& from,
                                                               const GroupViews& views,
                                                               const PoseSearchScale& scale);

/// Refines poses and drops duplicates and those with a score of 0 or less; best first.
[[nodiscard]] std::vector<PoseHypothesis> refine_pose_hypotheses(
    const ViewGroup& to,
    const ViewGroup& from,
    std::span<const Eigen::Isometry3d> starts,
    const GroupViews& views,
    const PoseSearchScale& scale);

/// Poses near a hypothesis, displaced in the two directions that are determined worst. A group that
/// slides on a face converges to several of them.
[[nodiscard]] std::vector<Eigen::Isometry3d> neighboring_poses(const PoseHypothesis& hypothesis,
                                                               const PoseSearchScale& scale);

/// Whether another pose differs from a hypothesis by a turn about its worst determined axis alone,
/// by any angle: the axis stays where it is.
[[nodiscard]] bool differs_by_turn(const PoseHypothesis& hypothesis,
                                   const Eigen::Isometry3d& other,
                                   const PoseSearchScale& scale);

/// A hypothesis turned about that axis, all the way around; none where the worst determined motion
/// is no turn.
[[nodiscard]] std::vector<Eigen::Isometry3d> turned_poses(const PoseHypothesis& hypothesis);

/// Sorts by `PoseHypothesis::score`, best first.
void sort_hypotheses(std::vector<PoseHypothesis>& hypotheses, double typical_mm);

}  // namespace frangia
