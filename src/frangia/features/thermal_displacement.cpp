#include "frangia/features/thermal_displacement.h"

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

namespace frangia {

Eigen::MatrixXf thermal_displacement(const Mesh& mesh,
                                     double expansion_per_k,
                                     double temperature_u_k) {
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) box.extend(vertex);
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  if (!box.isEmpty()) center = box.center();
  const auto scale = static_cast<float>(expansion_per_k * temperature_u_k);
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(1, static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!mesh.vertices_mm[i].allFinite()) continue;
    out(0, static_cast<Eigen::Index>(i)) = scale * (mesh.vertices_mm[i] - center).dot(normals[i]);
  }
  return out;
}

}  // namespace frangia
