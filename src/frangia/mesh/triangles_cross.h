#pragma once

#include <array>

#include <Eigen/Core>

namespace frangia {

/// A triangle's corners and which vertices they are.
struct CornerPlaces {
  std::array<std::uint32_t, 3> vertices;
  std::array<Eigen::Vector3d, 3> places_mm;
};

/// Whether two triangles with an area have a point in common beyond the corner or the edge that
/// they share. Decided exactly.
///
/// errors   Error(Input) in a build without CGAL
/// source   CGAL, 2D and 3D Linear Geometry Kernel: exact predicates
[[nodiscard]] bool triangles_cross(const CornerPlaces& a, const CornerPlaces& b);

}  // namespace frangia
