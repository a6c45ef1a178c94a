#pragma once

#include <cstdint>
#include <span>

#include "frangia/fusion/internal/place_vertices.h"

namespace frangia {

/// Settles the part of sigma that a face may bend within a cell by what the vertices around show of
/// it, in place.
///
/// A face that bends by an angle over a cell leaves its tangent plane by angle * edge / 2 at the
/// vertices beside it, its rise. The planes in the cell give a second angle, and the smaller of
/// both is used: beside an edge of the object the normals of the planes are less certain than their
/// points, since windows on one side of it fit them. Where the planes are one face and the vertices
/// beside do not lie on it, there is a step, between whose sides the surface may lie anywhere: the
/// larger one is used.
///
/// @shape    `on_edge`: not 0 for a vertex that was found on an edge of the object
void settle_bends(PlacedVertices& vertices, std::span<const std::uint8_t> on_edge);

}  // namespace frangia
