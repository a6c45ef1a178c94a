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

}  // namespace frangia
