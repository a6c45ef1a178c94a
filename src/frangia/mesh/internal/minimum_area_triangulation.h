#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace frangia {

struct MinimumAreaOptions {
  /// The surface's direction at each corner, or empty. A line of many corners is first shortened:
  /// corners that point into what is filled are cut off, the shortest cut first.
  std::vector<Eigen::Vector3d> normals;
  /// Chords that are taken only when there is no other way.
  std::function<bool(std::size_t, std::size_t)> is_forbidden;
};

/// Cuts a closed line through space into triangles of its own corners, of the least area.
///
/// shape    triples of indices of corners, the same way round as the line; none below three corners
/// source   Barequet & Sharir 1995, Filling Gaps in the Boundary of a Polyhedron
[[nodiscard]] std::vector<std::array<std::size_t, 3>> minimum_area_triangulation(
    const std::vector<Eigen::Vector3d>& corners_mm, const MinimumAreaOptions& options = {});

}  // namespace frangia
