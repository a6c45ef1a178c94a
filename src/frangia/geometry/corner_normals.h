#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Computes three normals for each triangle, for smooth shading with sharp edges.
///
/// The normal of a corner is the angle-weighted mean of the triangles around its vertex whose
/// normals differ from the corner's own triangle by less than the crease angle. shape    one array
/// for each triangle, in the order of its corners; unit vectors missing  the normals of a triangle
/// without area are zero
[[nodiscard]] std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(
    const Mesh& mesh, double crease_rad = rad_from_deg(40.0));

}  // namespace frangia
