#pragma once

#include <Eigen/Core>

#include "frangia/geometry/triangles_intersect.h"

namespace frangia {

/// Returns the point of triangle a, b, c nearest to p.
///
/// @source   Ericson, Real-Time Collision Detection, 5.1.5
[[nodiscard]] inline Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& a,
                                                         const Eigen::Vector3d& b,
                                                         const Eigen::Vector3d& c,
                                                         const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  }
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

/// Whether two triangles certainly do not intersect: a fast filter before `triangles_intersect`.
///
/// Coordinates are floats and the arithmetic is in double, with a bound on the rounding error. A
/// result of true is exact; false means undecided.
[[nodiscard]] bool surely_disjoint(const IndexedTriangle& a, const IndexedTriangle& b);

}  // namespace frangia
