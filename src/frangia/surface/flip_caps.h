#pragma once

#include "frangia/surface/mesh.h"

namespace frangia {

/// Turns the longest edge of each triangle that is lower than `lowest_mm`, in place, so that its
/// three corners no longer lie in a row.
///
/// Nothing is turned that would fold a triangle over or make the mesh non-manifold.
void flip_caps(Mesh& mesh, float lowest_mm);

}  // namespace frangia
