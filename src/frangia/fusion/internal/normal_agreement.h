#pragma once

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Returns twice the area vector of a triangle.
[[nodiscard]] inline Eigen::Vector3f doubled_area_vector(const Mesh& mesh,
                                                         const Mesh::Triangle& t) {
  const Eigen::Vector3f& origin = mesh.vertices_mm[t[0]];
  return (mesh.vertices_mm[t[1]] - origin).cross(mesh.vertices_mm[t[2]] - origin);
}

/// Returns the cosine of the angle between a triangle and the mean normal of its vertices.
///
/// @missing  `undefined` for a triangle without area, and where the normals cancel each other
[[nodiscard]] inline float normal_agreement(const Mesh& mesh,
                                            const Mesh::Triangle& t,
                                            float undefined) {
  const Eigen::Vector3f cross = doubled_area_vector(mesh, t);
  const Eigen::Vector3f outward = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
  const float size = cross.norm() * outward.norm();
  return size > 0.0F ? cross.dot(outward) / size : undefined;
}

}  // namespace frangia
