#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace frangia {

/// The vertices of a triangle and their positions.
struct IndexedTriangle {
  /// Indices of its vertices in the mesh; a shared vertex is no intersection.
  std::array<std::uint32_t, 3> vertices;
  std::array<Eigen::Vector3d, 3> corners_mm;  ///< their positions
};

/// Makes an IndexedTriangle of vertices whose positions are `position_of(vertex)`.
template <typename PositionOf>
[[nodiscard]] IndexedTriangle indexed_triangle(const std::array<std::uint32_t, 3>& vertices,
                                               const PositionOf& position_of) {
  return {vertices, {position_of(vertices[0]), position_of(vertices[1]), position_of(vertices[2])}};
}

/// Whether this build contains CGAL, which `triangles_intersect` needs.
[[nodiscard]] bool can_test_intersections();

/// Whether two triangles have a point in common other than the vertex or edge that they share. The
/// result is exact. A triangle without area intersects nothing.
///
/// @errors   Error(Input) in a build without CGAL
/// @source   CGAL, 2D and 3D Linear Geometry Kernel: exact predicates
[[nodiscard]] bool triangles_intersect(const IndexedTriangle& a, const IndexedTriangle& b);

}  // namespace frangia
