#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/view_group.h"

namespace frangia {

/// Patches of the surfaces of two groups in one pose.
struct PatchCount {
  std::size_t compared = 0;       ///< patches that the other group measured, too
  std::size_t contradicting = 0;  ///< those whose points are not where the other group saw the
                                  ///< surface
};

/// Natural logarithm of the odds of a pose over another one that contradicts more patches; negative
/// when it contradicts less.
///
/// Both have the contradictions of a sound pose, such as those at edges; these come in clusters, so
/// that their numbers scatter more than independent ones.
[[nodiscard]] double log_odds_of(const PatchCount& one, const PatchCount& other);

/// Counts where the surfaces of two groups contradict each other in a pose: where a point of one
/// lies in front of what the other measured, or near it but beyond noise.
///
/// Unlike the number of points that agree, contradictions do not depend on how much the groups
/// happen to share; and unlike the distance of points that agree, a small feature that lies
/// elsewhere is seen among many points that do not care. The groups must outlive this object.
class PoseContradictions {
 public:
  /// `spacing_mm` is that of the points of groups whose features are compared; the points that are
  /// counted are denser. `near`: a pose near the right one, in which most points agree.
  PoseContradictions(const ViewGroup& to,
                     const ViewGroup& from,
                     const GroupViews& views,
                     double spacing_mm,
                     const Eigen::Isometry3d& near);

  /// Counts the patches of both groups in a pose.
  [[nodiscard]] PatchCount count(const Eigen::Isometry3d& to_from) const;

  /// Standard deviation of the distances of points that agree.
  [[nodiscard]] double sigma_mm() const { return sigma_mm_; }

 private:
  /// Points of one group, each with the number of its patch.
  struct Samples {
    SurfacePoints points;
    std::vector<std::uint32_t> patch;
    std::uint32_t patches = 0;
  };
  /// Points of one group compared with the views of the other.
  struct Way {
    const Samples& samples;
    Eigen::Isometry3d target_from_points;
    const ViewGroup& target;
  };

  [[nodiscard]] static Samples samples_of(const ViewGroup& group,
                                          const GroupViews& views,
                                          double spacing_mm);
  void add(PatchCount& count, const Way& way) const;

  const ViewGroup& to_;
  const ViewGroup& from_;
  GroupViews views_;
  double spacing_mm_;
  double sigma_mm_ = 0.0;
  Samples of_to_;
  Samples of_from_;
};

}  // namespace frangia
