#pragma once

#include <cstdint>
#include <vector>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reconstructs the edges and corners of the object that sampling cut off, in place.
///
/// A pixel that straddles an edge observes a mean of both faces, and cells are no smaller than
/// pixels, so edges appear as chamfers up to about a voxel wide. The adjacent faces are
/// extrapolated: a chamfer vertex moves to the face it lies on, or to a nearby edge or corner, and
/// triangles that span two faces are split where the faces intersect. Fillets wider than a voxel,
/// folds too short to be an edge, and vertices that would fold a triangle over do not change.
///
/// Returns for each vertex 1 on an edge of the object, 2 on a corner, else 0.
/// @shape    a mesh with normals, sigma and views; `voxel_mm` is the spacing of its vertices
/// @source   Attene, Falcidieno, Rossignac & Spagnuolo 2005 (Sharpen & Bend)
std::vector<std::uint8_t> sharpen_edges(Mesh& mesh,
                                        float voxel_mm,
                                        const EdgeParameters& parameters = {});

}  // namespace frangia
