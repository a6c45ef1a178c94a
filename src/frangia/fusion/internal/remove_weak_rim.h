#pragma once

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Removes the triangles at vertices of the mesh's boundary that far fewer views observed than the
/// vertices around them, in place. The vertices remain.
///
/// Where a face ends that many views observed, the few whose last pixel reaches beyond its edge
/// leave single teeth a voxel long, which nothing behind them contradicts.
void remove_weak_rim(Mesh& mesh, const CleanupParameters& parameters = {});

/// Adds to the sigma of the vertices of strips that a single view observed and that are narrower
/// than its local fits. Such a strip may be the edge of two surfaces that pixels have
/// mixed into one: on the simulated shaft such strips bridge a step of 1 mm, up to a voxel off.
///
/// @shape    `mesh` has a sigma and the number of views of each vertex
/// @missing  the mesh stays as it is where it has no such strip, or no number of views
void widen_sigma_of_strips(Mesh& mesh, float voxel_mm);

}  // namespace frangia
