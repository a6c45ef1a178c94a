#pragma once

#include <cstddef>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Edge length, iterations and crease angle of isotropic remeshing.
struct RemeshOptions {
  double edge_mm = 1.0;                    ///< target length of all edges
  int iterations = 3;                      ///< of splitting, collapsing, flipping and relaxing
  double crease_rad = rad_from_deg(40.0);  ///< edges with a larger dihedral angle stay in place
};

/// Remeshes a surface into nearly equilateral triangles of one size.
///
/// Vertices stay on the original surface. Boundaries and sharp edges are split into equal pieces.
/// Each vertex takes its normal, sigma, views and mark from the nearest point of the original.
///
/// @units    mm
/// @errors   Error(Input) when the length or the iterations are not positive, when the result would
///          have more than `max_triangles` (the message names a length that fits), when the mesh is
///          not manifold (use make_manifold), or in a build without CGAL; Error(Cancelled)
/// @source   Botsch & Kobbelt 2004, A Remeshing Approach to Multiresolution Modeling, by CGAL
[[nodiscard]] Mesh remesh_isotropic(const Mesh& mesh,
                                    const RemeshOptions& options = {},
                                    const Run& run = {});

/// Estimates the number of triangles of a remeshed surface from its area.
///
/// @units    mm
[[nodiscard]] double estimate_remeshed_triangles(const Mesh& mesh, double edge_mm);

}  // namespace frangia
