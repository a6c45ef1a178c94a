#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/fit_primitives.h"

namespace frangia {

/// A ball and the points that lie on it.
struct FoundBall {
  Sphere sphere;                    ///< fitted to them; mm
  std::vector<std::size_t> points;  ///< indices of the given ones
};

/// Finds balls of a known radius among measured points, the one with most points first.
///
/// @units    mm
/// @missing  NaN points are on no ball
/// @source   RANSAC on four neighboring points, then `fit_sphere`
[[nodiscard]] std::vector<FoundBall> find_balls(std::span<const Eigen::Vector3d> points,
                                                double radius_mm,
                                                std::size_t count);

}  // namespace frangia
