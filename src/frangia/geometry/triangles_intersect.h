#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace frangia {

/// A triangle's corners and which vertices they are.
struct IndexedTriangle {
  std::array<std::uint32_t, 3> vertices;
  std::array<Eigen::Vector3d, 3> corners_mm;
};

/// Corners by their numbers, at places that `position_of` tells.
template <typename PositionOf>
[[nodiscard]] IndexedTriangle indexed_triangle(const std::array<std::uint32_t, 3>& vertices,
                                               const PositionOf& position_of) {
  return {vertices, {position_of(vertices[0]), position_of(vertices[1]), position_of(vertices[2])}};
}

/// False in a build without CGAL, where triangles_intersect fails.
[[nodiscard]] bool can_test_intersections();

/// Whether two triangles with an area have a point in common beyond the corner or the edge that
/// they share. Decided exactly.
///
/// errors   Error(Input) in a build without CGAL
/// source   CGAL, 2D and 3D Linear Geometry Kernel: exact predicates
[[nodiscard]] bool triangles_intersect(const IndexedTriangle& a, const IndexedTriangle& b);

}  // namespace frangia
