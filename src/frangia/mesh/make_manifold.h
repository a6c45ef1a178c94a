#pragma once

#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh with every edge in at most two triangles that run the same way round, and one fan of
/// triangles at every vertex.
///
/// Triangles with two equal corners, repeated ones (either way round), and ones of a vertex that is
/// not there or not finite go. At an edge of many triangles each pair that continues most
/// straightly keeps it; the others are parted from it, at the same places: nothing moves.
[[nodiscard]] Mesh make_manifold(Mesh mesh);

/// Edges with more than two triangles, or two that run against each other.
[[nodiscard]] std::size_t count_non_manifold_edges(const Mesh& mesh);
[[nodiscard]] std::size_t count_non_manifold_edges(const Mesh& mesh, const HalfEdges& edges);

}  // namespace frangia
