#include "frangia/geometry/corner_normals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/geometry/connectivity.h"

namespace frangia {
namespace {

/// Returns the triangle's unit normal times its angle at the corner.
Eigen::Vector3f weighted_normal(const Mesh& mesh, std::size_t corner) {
  const auto& triangle = mesh.triangles[corner / 3];
  const Eigen::Vector3f& here = mesh.vertices_mm[triangle[corner % 3]];
  const Eigen::Vector3f next = mesh.vertices_mm[triangle[(corner + 1) % 3]] - here;
  const Eigen::Vector3f last = mesh.vertices_mm[triangle[(corner + 2) % 3]] - here;
  const Eigen::Vector3f cross = next.cross(last);
  const float length = cross.norm();
  if (!(length > 0.0F)) return Eigen::Vector3f::Zero();
  return cross * (std::atan2(length, next.dot(last)) / length);
}

}  // namespace

std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const Mesh& mesh, double crease_rad) {
  constexpr std::size_t kChunk = 4096;
  const OneRings one_rings(mesh);
  std::vector<Eigen::Vector3f> weighted(3 * mesh.triangles.size());
  parallel_chunks(weighted.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      weighted[i] = weighted_normal(mesh, i);
  });

  const auto min_cos = static_cast<float>(std::cos(crease_rad));
  std::vector<std::array<Eigen::Vector3f, 3>> normals(mesh.triangles.size());
  parallel_chunks(weighted.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t vertex = mesh.triangles[i / 3][i % 3];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (const std::uint32_t t : one_rings.of(vertex)) {
        const auto* corner = std::find(mesh.triangles[t].begin(), mesh.triangles[t].end(), vertex);
        const auto k = static_cast<std::size_t>(corner - mesh.triangles[t].begin());
        const Eigen::Vector3f& other = weighted[3 * std::size_t{t} + k];
        if (other.dot(weighted[i]) >= min_cos * other.norm() * weighted[i].norm()) sum += other;
      }
      normals[i / 3][i % 3] = weighted[i].isZero() ? weighted[i] : sum.normalized();
    }
  });
  return normals;
}

}  // namespace frangia
