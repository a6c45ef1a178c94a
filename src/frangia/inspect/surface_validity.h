#pragma once

#include <cstddef>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/exact_surface.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Validity of a mesh: whether its sigma predicts its errors and its triangles form an oriented
/// manifold.
struct SurfaceValidity {
  double sigma_ratio = kMissing;  ///< RMS of error / sigma over the vertices; 1 when sigma is right
  std::size_t non_manifold_edges =
      0;  ///< with more than two triangles, or two of opposite orientation
  std::size_t inward_triangles = 0;  ///< that face against the nearest reference surface
};

/// Compares a mesh with a reference whose triangles face outward. `exact` is the surface that the
/// reference approximates; null: the reference is exact.
///
/// @missing  `sigma_ratio` is NaN for a mesh without sigma
[[nodiscard]] SurfaceValidity surface_validity(const Mesh& mesh,
                                               const RayScene& reference,
                                               const Run& run = {},
                                               const ExactSurface* exact = nullptr);

}  // namespace frangia
