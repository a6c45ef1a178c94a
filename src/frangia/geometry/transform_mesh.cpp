#include "frangia/geometry/transform_mesh.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/internal/triangle_area.h"
#include "frangia/geometry/triangle_predicates.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Plane = Eigen::Hyperplane<double, 3>;

Vector3d center_of(const Mesh& mesh, std::size_t triangle) {
  return (corner_mm(mesh, triangle, 0) + corner_mm(mesh, triangle, 1) +
          corner_mm(mesh, triangle, 2)) /
         3.0;
}

}  // namespace

Mesh transform_mesh(Mesh mesh, const Eigen::Isometry3d& target_from_mesh) {
  for (auto& vertex : mesh.vertices_mm)
    vertex = (target_from_mesh * vertex.cast<double>()).cast<float>();
  for (auto& normal : mesh.normals)
    normal = (target_from_mesh.linear() * normal.cast<double>()).cast<float>();
  return mesh;
}

Mesh mirror_mesh(Mesh mesh, const Plane& plane) {
  const Vector3d normal = plane.normal();
  for (auto& vertex : mesh.vertices_mm) {
    const Vector3d position = vertex.cast<double>();
    vertex = (position - 2.0 * plane.signedDistance(position) * normal).cast<float>();
  }
  for (auto& direction : mesh.normals) {
    const Vector3d n = direction.cast<double>();
    direction = (n - 2.0 * n.dot(normal) * normal).cast<float>();
  }
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

Plane fit_plane(const Mesh& mesh, const Selection& selection) {
  require(selection.size() == mesh.triangles.size(),
          "fit_plane: the selection must have one flag for each triangle");
  Vector3d mean = Vector3d::Zero();
  Vector3d outward = Vector3d::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < selection.size(); ++i) {
    if (selection[i] == 0) continue;
    const Vector3d area = doubled_area_vector(mesh, i);
    mean += area.norm() * center_of(mesh, i);
    outward += area;
    weight += area.norm();
  }
  require(weight > 0.0, "fit_plane: the selected triangles have no area");
  mean /= weight;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < selection.size(); ++i) {
    if (selection[i] == 0) continue;
    const double area = doubled_area_vector(mesh, i).norm();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d away = corner_mm(mesh, i, k) - mean;
      spread += area * away * away.transpose();
    }
  }
  Vector3d normal = symmetric_eigen(spread).vectors.col(0).normalized();
  if (normal.dot(outward) < 0.0) normal = -normal;
  return {normal, mean};
}

Selection select_face(const Mesh& mesh, const Vector3d& picked_mm, double within_rad) {
  require(!mesh.empty(), "select_face: the mesh has no triangle");
  std::uint32_t seed = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (doubled_area_vector(mesh, i).isZero()) continue;
    const Vector3d on = nearest_on_triangle(
        corner_mm(mesh, i, 0), corner_mm(mesh, i, 1), corner_mm(mesh, i, 2), picked_mm);
    const double apart = (on - picked_mm).squaredNorm();
    if (!(apart < nearest)) continue;
    nearest = apart;
    seed = i;
  }
  const HalfEdges edges(mesh);
  const Vector3d direction = doubled_area_vector(mesh, seed).stableNormalized();
  const double least = std::cos(within_rad);
  Selection face(mesh.triangles.size());
  std::vector<std::uint32_t> front{seed};
  face[seed] = 1;
  while (!front.empty()) {
    const std::uint32_t triangle = front.back();
    front.pop_back();
    for (std::uint32_t edge = 3 * triangle; edge < 3 * triangle + 3; ++edge) {
      if (!edges.has_twin(edge)) continue;
      const std::uint32_t other = edges.twin(edge) / 3;
      const Vector3d area = doubled_area_vector(mesh, other);
      if (face[other] != 0 || area.dot(direction) < least * area.norm()) continue;
      face[other] = 1;
      front.push_back(other);
    }
  }
  return face;
}

Eigen::Isometry3d align_faces(const Plane& first, const Plane& second, const Plane& third) {
  const Vector3d z = -first.normal();
  const Vector3d along = -second.normal();
  const Vector3d x_raw = along - along.dot(z) * z;
  require(x_raw.norm() > 1e-3,
          "align: the first and the second face are parallel; choose faces that meet at an angle");
  const Vector3d x = x_raw.normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = x.transpose();
  axes.row(1) = z.cross(x).transpose();
  axes.row(2) = z.transpose();
  Eigen::Matrix3d normals;
  normals.row(0) = first.normal().transpose();
  normals.row(1) = second.normal().transpose();
  normals.row(2) = third.normal().transpose();
  require(
      std::abs(normals.determinant()) > 1e-3,
      "align: the third face is parallel to the intersection of the other two; choose three faces "
      "that meet in a corner");
  const Vector3d origin =
      -(normals.inverse() * Vector3d(first.offset(), second.offset(), third.offset()));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = axes;
  pose.translation() = -(axes * origin);
  return pose;
}

}  // namespace frangia
