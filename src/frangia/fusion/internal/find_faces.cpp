#include "frangia/fusion/internal/find_faces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace frangia {
namespace {

/// Weighted moments of the vertices of one face.
struct FaceMoments {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();  ///< relative to the given point
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  float noise2 = 0.0F;  ///< mean variance of the vertices
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();
};

/// Vertices near the point have the largest weight, since a face may be curved.
FaceMoments moments_of(const Mesh& mesh,
                       const std::vector<std::uint32_t>& members,
                       const Eigen::Vector3f& near,
                       float reach_mm) {
  FaceMoments fit;
  float sum = 0.0F;
  const auto weight = [&](std::uint32_t v) {
    const float ratio2 = (mesh.vertices_mm[v] - near).squaredNorm() / (reach_mm * reach_mm);
    constexpr float kLeast = 0.01F;  // keeps the sum positive
    const float inner = std::max(0.0F, 1.0F - ratio2);
    return std::max(kLeast, inner * inner);
  };
  for (const std::uint32_t v : members) {
    sum += weight(v);
    fit.mean += weight(v) * (mesh.vertices_mm[v] - near);
    fit.noise2 += weight(v) * mesh.sigma_mm[v] * mesh.sigma_mm[v];
    fit.outward += mesh.normals[v];
  }
  fit.mean /= sum;
  fit.noise2 /= sum;
  for (const std::uint32_t v : members) {
    const Eigen::Vector3f off = mesh.vertices_mm[v] - near - fit.mean;
    fit.spread += weight(v) / sum * off * off.transpose();
  }
  return fit;
}

/// Returns the plane of a face; nothing when its vertices are not flat, or lie on a line.
std::optional<Faces::Plane> plane_through(const Mesh& mesh,
                                          const std::vector<std::uint32_t>& members,
                                          const Eigen::Vector3f& near,
                                          const EdgeLimits& limits) {
  const float voxel_mm = limits.voxel_mm;
  const FaceMoments fit = moments_of(mesh, members, near, limits.face_reach_mm);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(fit.spread);
  const Eigen::Vector3f squares = solver.eigenvalues() / (voxel_mm * voxel_mm);
  const float flat = limits.flat_voxels * limits.flat_voxels +
                     limits.flat_sigmas * limits.flat_sigmas * fit.noise2 / (voxel_mm * voxel_mm);
  if (!(squares[0] <= flat && squares[1] >= limits.face_width_voxels * limits.face_width_voxels))
    return std::nullopt;
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).normalized();
  return Faces::Plane(normal.dot(fit.outward) < 0.0F ? Eigen::Vector3f(-normal) : normal,
                      near + fit.mean);
}

/// Returns the largest set of vertices in the plane of one of them and with similar normals.
std::vector<std::uint32_t> largest_face(const Mesh& mesh,
                                        const std::vector<std::uint32_t>& vertices,
                                        const EdgeLimits& limits) {
  std::vector<std::uint32_t> best;
  for (const std::uint32_t seed : vertices) {
    const Eigen::Vector3f& normal = mesh.normals[seed];
    std::vector<std::uint32_t> members;
    for (const std::uint32_t v : vertices) {
      const float off = std::abs(normal.dot(mesh.vertices_mm[v] - mesh.vertices_mm[seed]));
      if (mesh.normals[v].dot(normal) > limits.face_normal_cosine && off < limits.face_offset_mm)
        members.push_back(v);
    }
    if (members.size() > best.size()) best = std::move(members);
  }
  return best;
}

}  // namespace

bool form_edge(const Eigen::Vector3f& one, const Eigen::Vector3f& other, const EdgeLimits& limits) {
  const float cosine = one.dot(other);
  return cosine < limits.min_edge_cosine && cosine > limits.max_edge_cosine;
}

Eigen::Vector3f intersect_planes(const Faces::Plane& one,
                                 const Faces::Plane& other,
                                 const Eigen::Vector3f& from) {
  const float cosine = one.normal().dot(other.normal());
  const float first = one.signedDistance(from);
  const float second = other.signedDistance(from);
  const Eigen::Vector3f step =
      (first - cosine * second) * one.normal() + (second - cosine * first) * other.normal();
  return from - step / (1.0F - cosine * cosine);
}

Eigen::Vector3f intersect_planes(const std::array<Faces::Plane, 3>& planes,
                                 const Eigen::Vector3f& from) {
  Eigen::Matrix3f rows;
  Eigen::Vector3f away;
  for (int i = 0; i < 3; ++i) {
    const Faces::Plane& plane = planes[static_cast<std::size_t>(i)];
    rows.row(i) = plane.normal().transpose();
    away[i] = plane.signedDistance(from);
  }
  return from - rows.inverse() * away;
}

Faces find_faces(const Mesh& mesh,
                 std::span<const std::uint32_t> vertices,
                 const Eigen::Vector3f& near,
                 const EdgeLimits& limits) {
  std::vector<std::uint32_t> left(vertices.begin(), vertices.end());
  Faces faces;
  while (faces.count < faces.planes.size() && left.size() >= limits.min_face_vertices) {
    const std::vector<std::uint32_t> members = largest_face(mesh, left, limits);
    if (members.size() < limits.min_face_vertices) break;
    const auto plane = plane_through(mesh, members, near, limits);
    const Eigen::Vector3f normal = plane ? plane->normal() : mesh.normals[members[0]];
    if (plane) faces.planes[faces.count++] = *plane;
    const auto same = [&](std::uint32_t v) { return !form_edge(mesh.normals[v], normal, limits); };
    left.erase(std::remove_if(left.begin(), left.end(), same), left.end());
  }
  const auto nearer = [&](const Faces::Plane& a, const Faces::Plane& b) {
    return a.absDistance(near) < b.absDistance(near);
  };
  std::sort(faces.planes.begin(),
            faces.planes.begin() + static_cast<std::ptrdiff_t>(faces.count),
            nearer);
  return faces;
}

}  // namespace frangia
