#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Copies vertex and triangle data from a scene to a mesh at nearest points: the interpolated
/// sigma and color, the fewest views of the nearest triangle, the mark of its nearest corner, and
/// for a triangle the mark of the triangle nearest to its centroid. Recomputes normals if the
/// scene's mesh has any.
///
/// @errors   Error(Cancelled)
void transfer_vertex_data(Mesh& mesh, const RayScene& scene, const Run& run = {});

}  // namespace frangia
