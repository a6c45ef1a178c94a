#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace frangia {

/// Signed distances of simple solids, negative inside, and ways to blend them. Lengths in mm.
///
/// @source   Inigo Quilez, "distance functions" and "smooth minimum"
using Position = Eigen::Vector3d;

[[nodiscard]] inline double ball(const Position& p, const Position& center, double radius) {
  return (p - center).norm() - radius;
}

/// First-order approximation: exact on the surface.
[[nodiscard]] inline double ellipsoid(const Position& p,
                                      const Position& center,
                                      const Position& radii) {
  const Position q = (p - center).cwiseQuotient(radii);
  const double k0 = q.norm();
  const double k1 = q.cwiseQuotient(radii).norm();
  return k1 > 1e-9 ? k0 * (k0 - 1.0) / k1 : -radii.minCoeff();
}

/// A rod with round ends whose radius changes linearly along it.
struct Rod {
  Position from, to;
  double from_radius, to_radius;
};

[[nodiscard]] inline double rod(const Position& p, const Rod& rod) {
  const Position along = rod.to - rod.from;
  const double t = std::clamp((p - rod.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - rod.from - t * along).norm() -
         (rod.from_radius + t * (rod.to_radius - rod.from_radius));
}

/// A disc on the z axis with rounded edges.
struct Disc {
  double low, high, radius, rounding;
};

[[nodiscard]] inline double disc(const Position& p, const Disc& disc) {
  const double out = std::hypot(p.x(), p.y()) - disc.radius + disc.rounding;
  const double up =
      std::abs(p.z() - 0.5 * (disc.low + disc.high)) - 0.5 * (disc.high - disc.low) + disc.rounding;
  return std::min(std::max(out, up), 0.0) + std::hypot(std::max(out, 0.0), std::max(up, 0.0)) -
         disc.rounding;
}

/// The union of two solids with a fillet of about `width` between them.
[[nodiscard]] inline double smooth_union(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

/// The first solid without the second, the edge rounded over about `width`.
[[nodiscard]] inline double smooth_difference(double a, double b, double width) {
  return -smooth_union(-a, b, width);
}

/// The intersection of two solids, the edge rounded over about `width`.
[[nodiscard]] inline double smooth_intersection(double a, double b, double width) {
  return -smooth_union(-a, -b, width);
}

}  // namespace frangia
