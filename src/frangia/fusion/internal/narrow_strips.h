#pragma once

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Adds to the sigma of the vertices of strips that a single view observed and that are narrower
/// than its local fits. Such a strip may be the edge of two surfaces that pixels have
/// mixed into one: on the simulated shaft such strips bridge a step of 1 mm, up to a voxel off.
///
/// @shape    `mesh` has a sigma and the number of views of each vertex
/// @missing  the mesh stays as it is where it has no such strip, or no number of views
void widen_sigma_of_strips(Mesh& mesh, float voxel_mm);

}  // namespace frangia
