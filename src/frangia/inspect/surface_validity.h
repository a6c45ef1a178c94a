#pragma once

#include <cstddef>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Whether a mesh is what it says: its sigma honest, its triangles the right way round.
struct SurfaceValidity {
  double sigma_ratio = kMissing;       ///< RMS of error over predicted sigma, by vertex
  std::size_t non_manifold_edges = 0;  ///< of more than two triangles, or of two against each other
  std::size_t inward_triangles = 0;    ///< that face against the truth beside them
};

/// shape    the mesh against a truth whose triangles face outward
/// missing  `sigma_ratio` is NaN of a mesh without sigma
[[nodiscard]] SurfaceValidity surface_validity(const Mesh& mesh,
                                               const RayScene& truth,
                                               const Run& run = {});

}  // namespace frangia
