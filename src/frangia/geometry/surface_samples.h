#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A point on the surface of a mesh.
struct SurfaceSample {
  Eigen::Vector3d point_mm;    ///< position on the triangle
  Eigen::Vector3d normal;      ///< of the triangle, unit, outward
  std::uint32_t triangle = 0;  ///< index into the mesh
};

/// Samples points uniformly over the area of a mesh. Equal seeds give equal points.
///
/// @shape    `count` samples; none for a mesh without area
/// @source   stratified by area: one sample in each of `count` equal parts; Turk 1990 in a triangle
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const Mesh& mesh,
                                                        std::size_t count,
                                                        std::uint64_t seed = 1);

/// Whether `predicate(point)` holds for all samples of a triangle: its corners, the centres of its
/// edges, its centroid, and a grid of points no farther apart than the spacing, but at most 200
/// points along an edge.
template <typename Predicate>
[[nodiscard]] bool all_triangle_samples(const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c,
                                        double spacing_mm,
                                        const Predicate& predicate) {
  constexpr double kMost = 200.0;
  const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  const int steps =
      2 * static_cast<int>(std::clamp(std::ceil(0.5 * longest / spacing_mm), 1.0, kMost));
  if (!predicate(Eigen::Vector3d((a + b + c) / 3.0))) return false;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const int there_and_back =
          i % 2 == 0 ? j : steps - i - j;  // each point beside the one before
      const double u = static_cast<double>(i) / steps;
      const double v = static_cast<double>(there_and_back) / steps;
      if (!predicate(Eigen::Vector3d(a + u * (b - a) + v * (c - a)))) return false;
    }
  }
  return true;
}

}  // namespace frangia
