#pragma once

#include "frangia/mesh/ray_scene.h"
#include "frangia/surface/mesh.h"

namespace frangia {

/// Gives each vertex of a mesh what is known at the nearest place of another: sigma between the
/// corners there, the fewest views, the worst mark; and each triangle the mark of the nearest one
/// to its middle. Normals are computed anew, when the other has any.
void take_vertex_data(Mesh& mesh, const RayScene& scene);

}  // namespace frangia
