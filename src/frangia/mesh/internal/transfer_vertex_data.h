#pragma once

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

/// Gives each vertex of a mesh what is known at the nearest position of another: sigma between the
/// corners there, the fewest views, the worst mark; and each triangle the mark of the nearest one
/// to its middle. Normals are computed anew, when the other has any.
void transfer_vertex_data(Mesh& mesh, const RayScene& scene);

}  // namespace frangia
