#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace frangia {

/// A triangle's corners and which vertices they are.
struct CornerPlaces {
  std::array<std::uint32_t, 3> vertices;
  std::array<Eigen::Vector3d, 3> places_mm;
};

/// Corners by their numbers, at places that `place_of` tells.
template <typename PlaceOf>
[[nodiscard]] CornerPlaces corner_places(const std::array<std::uint32_t, 3>& vertices,
                                         const PlaceOf& place_of) {
  return {vertices, {place_of(vertices[0]), place_of(vertices[1]), place_of(vertices[2])}};
}

/// False in a build without CGAL, where triangles_cross fails.
[[nodiscard]] bool can_tell_what_crosses();

/// Whether two triangles with an area have a point in common beyond the corner or the edge that
/// they share. Decided exactly.
///
/// errors   Error(Input) in a build without CGAL
/// source   CGAL, 2D and 3D Linear Geometry Kernel: exact predicates
[[nodiscard]] bool triangles_cross(const CornerPlaces& a, const CornerPlaces& b);

}  // namespace frangia
