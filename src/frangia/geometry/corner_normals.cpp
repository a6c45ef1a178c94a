#include "frangia/geometry/corner_normals.h"

#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// The triangles around each vertex: those of vertex v are corners[first[v]] to [first[v + 1]].
struct VertexCorners {
  std::vector<std::size_t> first;
  std::vector<std::size_t> corners;  ///< 3 * triangle + corner
};

VertexCorners corners_by_vertex(const Mesh& mesh) {
  VertexCorners at_vertex;
  at_vertex.first.assign(mesh.vertices_mm.size() + 1, 0);
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle)
      ++at_vertex.first[vertex + 1];
  }
  for (std::size_t v = 1; v < at_vertex.first.size(); ++v)
    at_vertex.first[v] += at_vertex.first[v - 1];
  at_vertex.corners.resize(3 * mesh.triangles.size());
  std::vector<std::size_t> next(at_vertex.first.begin(), at_vertex.first.end() - 1);
  for (std::size_t i = 0; i < at_vertex.corners.size(); ++i) {
    at_vertex.corners[next[mesh.triangles[i / 3][i % 3]]++] = i;
  }
  return at_vertex;
}

/// The triangle's normal times its angle at the corner.
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
  const VertexCorners at_vertex = corners_by_vertex(mesh);
  std::vector<Eigen::Vector3f> weighted(at_vertex.corners.size());
  parallel_chunks(weighted.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      weighted[i] = weighted_normal(mesh, i);
  });

  const auto min_cos = static_cast<float>(std::cos(crease_rad));
  std::vector<std::array<Eigen::Vector3f, 3>> normals(mesh.triangles.size());
  parallel_chunks(weighted.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t vertex = mesh.triangles[i / 3][i % 3];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t k = at_vertex.first[vertex]; k < at_vertex.first[vertex + 1]; ++k) {
        const Eigen::Vector3f& other = weighted[at_vertex.corners[k]];
        if (other.dot(weighted[i]) >= min_cos * other.norm() * weighted[i].norm()) sum += other;
      }
      normals[i / 3][i % 3] = weighted[i].isZero() ? weighted[i] : sum.normalized();
    }
  });
  return normals;
}

}  // namespace frangia
