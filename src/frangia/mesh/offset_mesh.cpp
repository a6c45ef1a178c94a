#include "frangia/mesh/offset_mesh.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/symmetric_eigen.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The planes around a vertex: the sum of w n n^T, and of w n.
struct Planes {
  Matrix3d squares = Matrix3d::Zero();
  Vector3d sum = Vector3d::Zero();
};

/// The shortest way to where all planes, moved by one, meet; along directions that no plane cares
/// about there is none.
Vector3d displacement_of(const Planes& planes) {
  constexpr double kFlat = 0.01;  // shares of the largest eigenvalue below it are noise
  const auto [values, vectors] = symmetric_eigen(planes.squares);
  Vector3d displacement = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!(values[i] > kFlat * values[2])) continue;
    const Vector3d axis = vectors.col(i);
    displacement += axis * (axis.dot(planes.sum) / values[i]);
  }
  return displacement;
}

}  // namespace

Mesh offset_mesh(Mesh mesh, double distance_mm) {
  std::vector<Planes> planes(mesh.vertices_mm.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d here = mesh.vertices_mm[triangle[i]].cast<double>();
      const Vector3d next = mesh.vertices_mm[triangle[(i + 1) % 3]].cast<double>() - here;
      const Vector3d last = mesh.vertices_mm[triangle[(i + 2) % 3]].cast<double>() - here;
      const Vector3d cross = next.cross(last);
      const double length = cross.norm();
      if (!(length > 0.0)) continue;
      const double angle = std::atan2(length, next.dot(last));
      const Vector3d normal = cross / length;
      planes[triangle[i]].squares += angle * normal * normal.transpose();
      planes[triangle[i]].sum += angle * normal;
    }
  }
  const std::vector<Eigen::Vector3f> before = mesh.vertices_mm;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (planes[v].sum.isZero()) continue;
    mesh.vertices_mm[v] =
        (before[v].cast<double>() + distance_mm * displacement_of(planes[v])).cast<float>();
  }
  mark_displaced(mesh, before);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
