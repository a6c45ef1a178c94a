#pragma once

#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/fusion/internal/place_vertices.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Joins the vertices of `place_vertices`: around each crossing that the views hold up, the quad of
/// the four cells that share its edge, cut along the diagonal that follows the surface.
///
/// No edge is in more than two triangles: where two neighbouring cells share a face that one sheet
/// of surface crosses twice, a vertex on the face keeps the two edges apart.
/// Vertices that would fold a triangle over go back into their cells, where none can.
/// missing  no quad where a cell has an unseen corner, nor where no view saw the surface
[[nodiscard]] Mesh mesh_quads(PlacedVertices vertices,
                              const EdgeCrossings& crossings,
                              const HermiteAccumulators& hermite);

}  // namespace frangia
