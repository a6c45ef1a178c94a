#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Makes a mesh manifold: each edge belongs to at most two consistently oriented triangles, and the
/// triangles at each vertex form one fan.
///
/// Removes triangles with two equal corners, duplicates, and triangles with a vertex that does not
/// exist or is not finite. Of triangles in both orientations the later ones are removed, unless
/// they are the face in which two bodies touch. Pairs the triangles at a non-manifold edge as they
/// enclose material, or, where some are left over, by the smallest dihedral angle, and gives each
/// pair copies of the vertices: bodies that touch are separate. No vertex moves.
///
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh make_manifold(Mesh mesh, const Run& run = {});

/// Counts the edges with more than two triangles or with two of inconsistent orientation.
[[nodiscard]] std::size_t count_non_manifold_edges(const Mesh& mesh);
/// The same with the half-edges of the mesh, if they are known.
[[nodiscard]] std::size_t count_non_manifold_edges(const Mesh& mesh, const HalfEdges& edges);

}  // namespace frangia
