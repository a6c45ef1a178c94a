#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"

namespace frangia {

struct MinimumAreaOptions {
  /// The surface normal at each vertex, or empty. With normals, a long polygon is first shortened
  /// by cutting ears: convex corners, the one with the shortest chord first.
  std::vector<Eigen::Vector3d> normals;
  /// Chords to avoid unless every triangulation needs them.
  std::function<bool(std::size_t, std::size_t)> is_forbidden;
};

/// Triangulates a closed polygon in space with minimum area, using its own vertices only.
///
/// A polygon that is longer than 250 vertices after cutting ears is divided into shorter ones.
///
/// @shape    triples of vertex indices, oriented like the polygon; empty below three vertices
/// @errors   Error(Cancelled)
/// @source   Barequet & Sharir 1995, Filling Gaps in the Boundary of a Polyhedron
[[nodiscard]] std::vector<std::array<std::size_t, 3>> minimum_area_triangulation(
    const std::vector<Eigen::Vector3d>& corners_mm,
    const MinimumAreaOptions& options = {},
    const Run& run = {});

}  // namespace frangia
