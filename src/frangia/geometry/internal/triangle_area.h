#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Returns one of the three corners of a triangle.
[[nodiscard]] inline Eigen::Vector3d corner_mm(const Mesh& mesh,
                                               std::size_t triangle,
                                               std::size_t corner) {
  return mesh.vertices_mm[mesh.triangles[triangle][corner]].cast<double>();
}

/// Returns twice the area vector of a triangle, along its outward normal, in mm^2.
[[nodiscard]] inline Eigen::Vector3d doubled_area_vector(const Mesh& mesh, std::size_t triangle) {
  const Eigen::Vector3d a = corner_mm(mesh, triangle, 0);
  return (corner_mm(mesh, triangle, 1) - a).cross(corner_mm(mesh, triangle, 2) - a);
}

}  // namespace frangia
