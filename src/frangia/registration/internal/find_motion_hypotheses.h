#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/internal/match_features.h"
#include "frangia/registration/surface_points.h"

namespace frangia {

/// A rigid motion that many matches agree on.
struct MotionHypothesis {
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();
  std::size_t matches = 0;  ///< that it brings together
};

struct MotionHypothesisOptions {
  double tolerance_mm = 1.0;        ///< how far apart matched points may come to lie
  std::size_t seeds = 80;           ///< matches that are tried
  std::size_t max_hypotheses = 20;  ///< motions that are returned
};

/// The motions that groups of matches agree on, most matches first.
///
/// Two matches fit together when the distance of their points and the angles of their normals are
/// the same in both sets. A match is trusted by how many others fit together with it and with each
/// other, which one right match in a hundred is enough for. No chance is involved.
/// source   second-order compatibility: Chen et al. 2022 (SC2-PCR)
[[nodiscard]] std::vector<MotionHypothesis> find_motion_hypotheses(
    const SurfacePoints& from,
    const SurfacePoints& to,
    std::span<const FeatureMatch> matches,
    const MotionHypothesisOptions& options = {});

/// Whether two motions bring points within `radius_mm` of `center` to places not farther apart than
/// `within_mm`.
[[nodiscard]] bool is_same_motion(const Eigen::Isometry3d& one,
                                  const Eigen::Isometry3d& other,
                                  const Eigen::Vector3d& center,
                                  double radius_mm,
                                  double within_mm);

}  // namespace frangia
