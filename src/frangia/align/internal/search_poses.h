#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frangia/align/internal/fit_pose.h"

namespace frangia {

/// A pose and how well some samples fit in it.
struct RatedPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double cost = 0.0;  ///< mean over the samples of min(distance, reach)^2 / reach^2, 0 to 1
};

/// Nearest points of a reference on a coarse grid, for fast and approximate queries.
class CoarseFeet {
 public:
  CoarseFeet(const RayScene& reference, const Run& run);

  /// The foot of the nearest grid point; none outside of the grid.
  [[nodiscard]] std::optional<Foot> of(const Eigen::Vector3d& point_mm) const;
  [[nodiscard]] double cell_mm() const { return cell_mm_; }

 private:
  Eigen::Vector3d origin_;
  double cell_mm_ = 0.0;
  Eigen::Array3i size_;
  std::vector<Eigen::Vector3f> points_, normals_;
};

/// Poses in which samples of a mesh may fit a reference, from evenly spread rotations; the best
/// first, no two nearly alike.
[[nodiscard]] std::vector<RatedPose> search_poses(std::span<const MeasuredSample> samples,
                                                  std::span<const MeasuredSample> reference_samples,
                                                  const RayScene& reference,
                                                  std::size_t rotations,
                                                  std::uint64_t seed,
                                                  const Run& run);

/// RMS distance between the samples in two poses.
[[nodiscard]] double pose_distance_mm(std::span<const MeasuredSample> samples,
                                      const Eigen::Isometry3d& a,
                                      const Eigen::Isometry3d& b);

}  // namespace frangia
