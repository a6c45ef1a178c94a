#pragma once

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/fusion/internal/place_vertices.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Connects the vertices of `place_vertices` to a triangle mesh with sharp edges and without
/// slivers.
///
/// Each supported crossing gets the quad of the four cells around its grid edge, cut along the
/// diagonal that follows the surface. The mesh is manifold: where one sheet of the surface crosses
/// the face between two cells twice, an additional vertex on the face separates the two edges.
/// Vertices that fold a triangle over return to their cells, where no triangle can fold.
/// @missing  no quad where a cell has a corner without a distance, nor at an unsupported crossing
[[nodiscard]] Mesh mesh_quads(PlacedVertices vertices,
                              const EdgeCrossings& crossings,
                              const HermiteAccumulators& hermite,
                              const FusionParameters& parameters = {});

}  // namespace frangia
