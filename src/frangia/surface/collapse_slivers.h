#pragma once

#include <cstdint>
#include <span>

#include "frangia/surface/mesh.h"

namespace frangia {

/// Joins vertices that an edge shorter than `shortest_mm` connects, in place.
///
/// A vertex on an edge of the object stays where it is when the other one is not; two alike meet in
/// the middle. Nothing is joined that would fold a triangle over or make the mesh non-manifold.
/// shape    `sharp`: not 0 for a vertex on an edge or a corner of the object; further ones are not
void collapse_slivers(Mesh& mesh, std::span<const std::uint8_t> sharp, float shortest_mm);

}  // namespace frangia
