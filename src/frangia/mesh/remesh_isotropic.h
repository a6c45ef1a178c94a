#pragma once

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

struct RemeshOptions {
  double edge_mm = 1.0;                    ///< the length that all edges come near to
  int iterations = 3;                      ///< of splitting, joining, turning and evening out
  double crease_rad = rad_from_deg(40.0);  ///< sharper edges of the part stay where they are
};

/// The same surface with triangles alike: nearly equilateral, of one size.
///
/// Vertices stay on the surface as it was; boundaries and sharp edges are cut into equal pieces.
/// Each vertex takes normal, sigma, views and mark from the nearest place of what was there.
/// errors   Error(Input) when the length or the iterations are not positive, when the mesh is not
///          manifold (make_manifold first), or in a build without CGAL
/// source   Botsch & Kobbelt 2004, A Remeshing Approach to Multiresolution Modeling, by CGAL
[[nodiscard]] Mesh remesh_isotropic(const Mesh& mesh,
                                    const RemeshOptions& options = {},
                                    const Run& run = {});

}  // namespace frangia
