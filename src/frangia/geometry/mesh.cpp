#include "frangia/geometry/mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace frangia {

std::vector<Eigen::Vector3f> vertex_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> normals(mesh.vertices_mm.size(), Eigen::Vector3f::Zero());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f& here = mesh.vertices_mm[triangle[corner]];
      const Eigen::Vector3f next = mesh.vertices_mm[triangle[(corner + 1) % 3]] - here;
      const Eigen::Vector3f last = mesh.vertices_mm[triangle[(corner + 2) % 3]] - here;
      const Eigen::Vector3f cross = next.cross(last);
      const float length = cross.norm();
      if (length > 0.0F) {
        normals[triangle[corner]] += cross * (std::atan2(length, next.dot(last)) / length);
      }
    }
  }
  for (auto& normal : normals) {
    const float length = normal.norm();
    if (length > 0.0F) normal /= length;
  }
  return normals;
}

}  // namespace frangia
