#pragma once

#include <cstdint>
#include <span>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Lays folds out flat, in place: triangles that face against the normals of their corners, or lean
/// more than 70 degrees off them.
///
/// Where noise is as large as triangles, a vertex may come to lie beyond its neighbours. It moves
/// along the surface, not across it, towards their middle; at the rim, where that would move the
/// rim, the triangle goes. What faces inward all the same is taken away, too.
/// shape    `sharp`: not 0 for a vertex on an edge or a corner of the object, which stays where it
/// is
void remove_foldovers(Mesh& mesh, std::span<const std::uint8_t> sharp);

}  // namespace frangia
