#include "frangia/fusion/internal/sliver_candidates.h"

#include <algorithm>
#include <iterator>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"

namespace frangia {

bool is_low(const Mesh& mesh, const Mesh::Triangle& t, float lowest_mm) {
  const Eigen::Vector3f& a = mesh.vertices_mm[t[0]];
  const Eigen::Vector3f& b = mesh.vertices_mm[t[1]];
  const Eigen::Vector3f& c = mesh.vertices_mm[t[2]];
  const float longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).squaredNorm() < lowest_mm * lowest_mm * longest;
}

SliverCandidates::SliverCandidates(const Mesh& mesh, float shortest_mm, float lowest_mm) {
  const auto has_short_edge = [&](const Mesh::Triangle& t) {
    const Eigen::Vector3f& a = mesh.vertices_mm[t[0]];
    const Eigen::Vector3f& b = mesh.vertices_mm[t[1]];
    const Eigen::Vector3f& c = mesh.vertices_mm[t[2]];
    return std::min({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}) <
           shortest_mm * shortest_mm;
  };
  constexpr std::size_t kChunk = 65536;
  std::vector<std::vector<std::uint32_t>> parts((mesh.triangles.size() + kChunk - 1) / kChunk);
  parallel_chunks(mesh.triangles.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Mesh::Triangle& corners = mesh.triangles[t];
      if (has_short_edge(corners) || is_low(mesh, corners, lowest_mm))
        parts[begin / kChunk].push_back(static_cast<std::uint32_t>(t));
    }
  });
  for (const auto& part : parts)
    triangles_.insert(triangles_.end(), part.begin(), part.end());
}

void SliverCandidates::add(const std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> all;
  all.reserve(triangles_.size() + triangles.size());
  std::set_union(triangles_.begin(),
                 triangles_.end(),
                 triangles.begin(),
                 triangles.end(),
                 std::back_inserter(all));
  triangles_ = std::move(all);
}

}  // namespace frangia
