#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Three normals a triangle for smooth shading that keeps edges sharp.
///
/// Each corner takes the mean of the triangles around its vertex that turn from its own by less
/// than the crease angle, weighted by their angles there.
/// shape    one array a triangle, in the order of its corners; unit
/// missing  a triangle without area has zero normals
[[nodiscard]] std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(
    const Mesh& mesh, double crease_rad = rad_from_deg(40.0));

}  // namespace frangia
