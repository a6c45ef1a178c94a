#include "frangia/inspection/internal/continuous_walls.h"

#include <cmath>

#include "frangia/core/disjoint_sets.h"

namespace frangia::inspection {

std::vector<std::vector<std::uint32_t>> continuous_walls(const Mesh& mesh,
                                                         const Thickness& walls,
                                                         const std::vector<bool>& counts) {
  // The walls are inclined to each other by 45 degrees at most, and each to the edge.
  constexpr float kMostSlope = 2.0F;
  constexpr float kSigmas = 4.0F;
  DisjointSets sets(counts.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle.at(i);
      const std::uint32_t b = triangle.at((i + 1) % 3);
      if (!counts[a] || !counts[b]) continue;
      float most = kMostSlope * (mesh.vertices_mm[a] - mesh.vertices_mm[b]).norm();
      if (!walls.u_mm.empty()) most += kSigmas * std::hypot(walls.u_mm[a], walls.u_mm[b]);
      if (!(std::abs(walls.thickness_mm[a] - walls.thickness_mm[b]) > most)) sets.join(a, b);
    }
  }
  std::vector<std::vector<std::uint32_t>> found;
  std::vector<std::size_t> number(counts.size(), 0);  // of the wall of a root, from 1
  for (std::uint32_t v = 0; v < counts.size(); ++v) {
    if (!counts[v]) continue;
    std::size_t& wall = number[sets.find(v)];
    if (wall == 0) {
      found.emplace_back();
      wall = found.size();
    }
    found[wall - 1].push_back(v);
  }
  return found;
}

}  // namespace frangia::inspection
