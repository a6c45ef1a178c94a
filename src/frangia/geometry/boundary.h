#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// A closed loop of the mesh's boundary: around a hole, or around an open sheet.
struct BoundaryLoop {
  std::vector<std::uint32_t>
      edges;               ///< half-edges without a twin; each starts where the previous one ends
  double length_mm = 0.0;  ///< sum of the lengths of its edges
  double size_mm = 0.0;    ///< diameter of the ball around the mean vertex that contains the loop
};

/// Finds all boundary loops, in the order of their first half-edges.
///
/// @missing  a loop through a non-manifold edge is left out; call `make_manifold` first
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(const Mesh& mesh, const HalfEdges& edges);
/// The same; builds the half-edges itself.
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(const Mesh& mesh);

/// Returns the vertices of a loop in its order.
[[nodiscard]] std::vector<std::uint32_t> vertices_of(const Mesh& mesh, const BoundaryLoop& loop);

/// Selects the triangles that have a vertex on a loop.
[[nodiscard]] Selection select_loop(const Mesh& mesh, const BoundaryLoop& loop);

/// Whether each vertex is at the boundary of a mesh: its triangles do not close around it.
///
/// @shape    one for each vertex; a vertex without a triangle is not at the boundary
[[nodiscard]] std::vector<bool> boundary_vertices(const Mesh& mesh);

}  // namespace frangia
