#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/internal/surface_features.h"
#include "frangia/registration/surface_points.h"

namespace frangia {

/// A rigid motion that many matches agree on.
struct MotionHypothesis {
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();
  std::size_t matches = 0;  ///< that the motion aligns
};

struct MotionHypothesisOptions {
  double tolerance_mm = 0.0;        ///< distance of matched points after the motion; required
  std::size_t seeds = 80;           ///< matches that are tried as the start of a consensus
  std::size_t max_hypotheses = 20;  ///< returned at most
};

/// Finds rigid motions that many matches agree on, those with the most matches first.
///
/// Two matches are compatible when the distance of their points and the angles of their normals are
/// equal in both sets. The score of a match counts the pairs of matches that are compatible with it
/// and with each other. The search is deterministic.
/// @source   second-order compatibility: Chen et al. 2022 (SC2-PCR)
[[nodiscard]] std::vector<MotionHypothesis> find_motion_hypotheses(
    const SurfacePoints& from,
    const SurfacePoints& to,
    std::span<const FeatureMatch> matches,
    const MotionHypothesisOptions& options = {});

/// Whether two motions move points within `radius_mm` of `center` to positions that differ by less
/// than `within_mm`.
[[nodiscard]] bool is_same_motion(const Eigen::Isometry3d& one,
                                  const Eigen::Isometry3d& other,
                                  const Eigen::Vector3d& center,
                                  double radius_mm,
                                  double within_mm);

}  // namespace frangia
