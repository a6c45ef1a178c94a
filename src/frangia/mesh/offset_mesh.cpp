#include "frangia/mesh/offset_mesh.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/steps_per_check.h"

namespace frangia {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Normal equations of the planes around a vertex.
struct VertexPlanes {
  Matrix3d squares = Matrix3d::Zero();  ///< sum of w n n^T
  Vector3d sum = Vector3d::Zero();      ///< sum of w n
};

std::vector<VertexPlanes> vertex_planes(const Mesh& mesh) {
  std::vector<VertexPlanes> planes(mesh.vertices_mm.size());
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
  return planes;
}

/// The shortest displacement to the intersection of all planes offset by 1. It has no part along
/// directions that the planes do not constrain.
Vector3d unit_displacement(const VertexPlanes& planes) {
  // Eigenvalues below this fraction of the largest one are noise of the normals. It corresponds to
  // normals that differ by 0.1 rad.
  constexpr double kMinEigenvalue = 0.01;
  const auto [values, vectors] = symmetric_eigen(planes.squares);
  Vector3d displacement = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!(values[i] > kMinEigenvalue * values[2])) continue;
    const Vector3d axis = vectors.col(i);
    displacement += axis * (axis.dot(planes.sum) / values[i]);
  }
  return displacement;
}

/// Whether a vertex keeps the distance of the offset from the original surface, on the side of the
/// offset. On an offset surface that exists, some vertices do.
bool any_keeps_distance(const Mesh& original,
                        const std::vector<Eigen::Vector3f>& offset_mm,
                        double distance_mm,
                        const Run& run) {
  constexpr double kShare = 0.99;  // of the distance: room for rounding
  const RayScene scene(original, run);
  for (std::size_t v = 0; v < offset_mm.size(); ++v) {
    if (v % kStepsPerCheck == 0) run.check();
    if (offset_mm[v] == original.vertices_mm[v]) continue;
    const auto nearest = scene.nearest(offset_mm[v].cast<double>());
    if (!nearest) continue;
    const double along_mm = std::copysign(1.0, distance_mm) * nearest->signed_distance_mm;
    if (along_mm >= kShare * std::abs(distance_mm)) return true;
  }
  return false;
}

}  // namespace

Mesh offset_mesh(Mesh mesh, double distance_mm, const Run& run) {
  run.check();
  const std::vector<VertexPlanes> planes = vertex_planes(mesh);
  std::vector<Eigen::Vector3f> offset_mm = mesh.vertices_mm;
  for (std::size_t v = 0; v < offset_mm.size(); ++v) {
    if (v % kStepsPerCheck == 0) run.check();
    if (planes[v].sum.isZero()) continue;
    offset_mm[v] =
        (offset_mm[v].cast<double>() + distance_mm * unit_displacement(planes[v])).cast<float>();
  }
  if (offset_mm == mesh.vertices_mm) return mesh;
  if (!any_keeps_distance(mesh, offset_mm, distance_mm, run)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("an offset of {:.4g} mm leaves nothing of the surface; choose a smaller "
                    "distance",
                    distance_mm));
  }
  std::swap(mesh.vertices_mm, offset_mm);
  mark_displaced(mesh, offset_mm);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
