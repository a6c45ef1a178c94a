#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// A closed way along the mesh's boundary: the boundary of a hole, or of an open sheet.
struct BoundaryLoop {
  std::vector<std::uint32_t>
      edges;  ///< half-edges without a twin, each beginning where the last ends
  double length_mm = 0.0;
  double size_mm = 0.0;  ///< diameter of the ball about the mean of its corners that holds it
};

/// All of them, in the order of their first half-edge. A way that meets a place where the mesh is
/// not manifold is left out: make_manifold first.
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(const Mesh& mesh, const HalfEdges& edges);
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(const Mesh& mesh);

/// The corners of a loop, in its order.
[[nodiscard]] std::vector<std::uint32_t> vertices_of(const Mesh& mesh, const BoundaryLoop& loop);

/// The triangles that touch a loop.
[[nodiscard]] Selection select_loop(const Mesh& mesh, const BoundaryLoop& loop);

}  // namespace frangia
