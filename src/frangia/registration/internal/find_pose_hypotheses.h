#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/view_group.h"

namespace frangia {

/// Places are told apart, and points agree, by shares of the spacing of the groups' points.
struct PoseSearchScale {
  double spacing_mm = 1.0;

  [[nodiscard]] double gate_mm() const { return 0.3 * spacing_mm; }         ///< what agrees
  [[nodiscard]] double coarse_gate_mm() const { return 1.2 * spacing_mm; }  ///< motions are as near
  [[nodiscard]] double distinct_mm() const { return 1.5 * spacing_mm; }  ///< hypotheses that differ
};

/// A place of one group on another that may be right.
struct PoseHypothesis {
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();
  GroupFit fit;

  /// What it is worth, where surfaces that are one come to lie `typical_mm` apart: points that
  /// agree, less those against it.
  [[nodiscard]] double score(double typical_mm) const;
};

/// A group and the features of its points.
struct DescribedGroup {
  const ViewGroup& group;
  const Eigen::MatrixXf& features;
};

/// Places of one group on another by their shape alone, refined; best first, at most a few.
[[nodiscard]] std::vector<PoseHypothesis> find_pose_hypotheses(const DescribedGroup& to,
                                                               const DescribedGroup& from,
                                                               const GroupViews& views,
                                                               const PoseSearchScale& scale);

/// Refines hypotheses and drops those that come to be the same or worth nothing; best first.
[[nodiscard]] std::vector<PoseHypothesis> refine_pose_hypotheses(
    const ViewGroup& to,
    const ViewGroup& from,
    std::span<const Eigen::Isometry3d> starts,
    const GroupViews& views,
    const PoseSearchScale& scale);

/// Places beside one, shifted and turned in the two ways that are known least: what slides on a
/// face converges to many of them.
[[nodiscard]] std::vector<Eigen::Isometry3d> neighboring_poses(const PoseHypothesis& hypothesis,
                                                               const PoseSearchScale& scale);

/// Puts the best first, by `PoseHypothesis::score`.
void sort_hypotheses(std::vector<PoseHypothesis>& hypotheses, double typical_mm);

}  // namespace frangia
