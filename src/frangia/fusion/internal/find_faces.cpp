#include "frangia/fusion/internal/find_faces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace frangia {
namespace {

constexpr std::size_t kFewest = 5;

/// Of the vertices of one face, how far they lie off their plane.
struct Fit {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();  ///< from the point that it is for
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  float noise2 = 0.0F;  ///< mean of their variance
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();
};

/// Vertices near the point count most: a face may be curved.
Fit fit_of(const Mesh& mesh,
           const std::vector<std::uint32_t>& members,
           const Eigen::Vector3f& near,
           float reach_mm) {
  Fit fit;
  float sum = 0.0F;
  const auto weight = [&](std::uint32_t v) {
    const float ratio2 = (mesh.vertices_mm[v] - near).squaredNorm() / (reach_mm * reach_mm);
    constexpr float kLeast = 0.01F;
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

/// The best plane through some vertices, when they lie in one and not in a row.
std::optional<Faces::Plane> plane_through(const Mesh& mesh,
                                          const std::vector<std::uint32_t>& members,
                                          const Eigen::Vector3f& near,
                                          float voxel_mm) {
  constexpr float kFlat = 0.03F;  // voxels off the plane, RMS, beyond
  constexpr float kNoise = 2.0F;  // sigmas
  constexpr float kWide = 0.2F;   // voxels
  const Fit fit = fit_of(mesh, members, near, kFaceReach * voxel_mm);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(fit.spread);
  const Eigen::Vector3f squares = solver.eigenvalues() / (voxel_mm * voxel_mm);
  const float flat = kFlat * kFlat + kNoise * kNoise * fit.noise2 / (voxel_mm * voxel_mm);
  if (!(squares[0] <= flat && squares[1] >= kWide * kWide)) return std::nullopt;
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).normalized();
  return Faces::Plane(normal.dot(fit.outward) < 0.0F ? Eigen::Vector3f(-normal) : normal,
                      near + fit.mean);
}

/// The most vertices that lie on one plane with one of them, and face alike.
std::vector<std::uint32_t> largest_face(const Mesh& mesh,
                                        const std::vector<std::uint32_t>& vertices,
                                        float voxel_mm) {
  constexpr float kAlike = 0.94F;  // cosine
  constexpr float kOff = 0.25F;    // voxels
  std::vector<std::uint32_t> best;
  for (const std::uint32_t seed : vertices) {
    const Eigen::Vector3f& normal = mesh.normals[seed];
    std::vector<std::uint32_t> members;
    for (const std::uint32_t v : vertices) {
      const float off = std::abs(normal.dot(mesh.vertices_mm[v] - mesh.vertices_mm[seed]));
      if (mesh.normals[v].dot(normal) > kAlike && off < kOff * voxel_mm) members.push_back(v);
    }
    if (members.size() > best.size()) best = std::move(members);
  }
  return best;
}

}  // namespace

bool form_edge(const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
  constexpr float kNearest = 0.87F;
  constexpr float kFarthest = -0.77F;
  const float cosine = one.dot(other);
  return cosine < kNearest && cosine > kFarthest;
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
                 float voxel_mm) {
  std::vector<std::uint32_t> left(vertices.begin(), vertices.end());
  Faces faces;
  while (faces.count < faces.planes.size() && left.size() >= kFewest) {
    const std::vector<std::uint32_t> members = largest_face(mesh, left, voxel_mm);
    if (members.size() < kFewest) break;
    const auto plane = plane_through(mesh, members, near, voxel_mm);
    const Eigen::Vector3f normal = plane ? plane->normal() : mesh.normals[members[0]];
    if (plane) faces.planes[faces.count++] = *plane;
    const auto same = [&](std::uint32_t v) { return !form_edge(mesh.normals[v], normal); };
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
