#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A polygon of a file as triangles.
struct PolygonTriangles {
  std::vector<std::array<std::size_t, 3>> triangles;  ///< corners of the polygon, from 0
  double off_plane =
      0.0;               ///< largest distance of a corner from the mean plane, in units of the file
  bool crosses = false;  ///< the outline crosses itself in that plane: its triangles are a fan
};

/// Triangulates a polygon in its mean plane without further points: n corners give n - 2 triangles
/// with the orientation of the polygon. A convex polygon becomes a fan around its first corner.
///
/// @source   Newell's method for the plane; Eberly, Triangulation by Ear Clipping
[[nodiscard]] PolygonTriangles polygon_triangles(std::span<const Eigen::Vector3d> corners);

}  // namespace frangia
