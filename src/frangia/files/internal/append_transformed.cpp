#include "frangia/files/internal/append_transformed.h"

#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

void append_transformed(Mesh& mesh,
                        const Mesh& part,
                        const Eigen::Affine3d& mesh_from_part,
                        const std::filesystem::path& path) {
  const auto fail = [&](const char* why) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
  };
  if (!mesh_from_part.matrix().allFinite())
    fail("the transform of a part is not finite; export it again");
  const std::size_t first_vertex = mesh.vertices_mm.size();
  const std::size_t first_triangle = mesh.triangles.size();
  append_mesh(mesh, part);
  for (std::size_t i = first_vertex; i < mesh.vertices_mm.size(); ++i)
    mesh.vertices_mm[i] = (mesh_from_part * mesh.vertices_mm[i].cast<double>()).cast<float>();
  const Eigen::Matrix3d linear = mesh_from_part.linear();
  if (!mesh.normals.empty()) {
    const Eigen::Matrix3d normal_transform = linear.inverse().transpose();
    for (std::size_t i = first_vertex; i < mesh.normals.size(); ++i) {
      const Eigen::Vector3d normal = (normal_transform * mesh.normals[i].cast<double>());
      mesh.normals[i] = normal.allFinite()
                            ? Eigen::Vector3f(normal.stableNormalized().cast<float>())
                            : Eigen::Vector3f(Eigen::Vector3f::Zero());
    }
  }
  if (linear.determinant() < 0.0) {
    for (std::size_t i = first_triangle; i < mesh.triangles.size(); ++i)
      std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  }
}

}  // namespace frangia
