#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/place_vertices.h"
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

/// Settles the part of sigma that a face may bend within a cell by what the vertices around show of
/// it, in place.
///
/// A face that bends by an angle over a cell leaves its tangent plane by angle * edge / 2 at the
/// adjacent vertices, its rise. The planes in the cell give a second angle, and the smaller of
/// both is used: next to an edge of the object the normals of the planes are less certain than
/// their points, since windows on one side of it fit them. Where the planes are one face and the
/// adjacent vertices do not lie on it, there is a step, between whose sides the surface may lie
/// anywhere: the larger one is used.
///
/// @shape    `on_edge`: not 0 for a vertex that was found on an edge of the object
void settle_bends(PlacedVertices& vertices, std::span<const std::uint8_t> on_edge);

}  // namespace frangia
