#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/surface/mesh.h"

namespace frangia {

[[nodiscard]] inline bool has_corner(const Mesh::Triangle& t, std::uint32_t vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// The triangles around the ends of some edges.
class Stars {
 public:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  Stars(const Mesh& mesh, const std::vector<Edge>& edges) : place_(mesh.vertices_mm.size(), kNone) {
    std::uint32_t count = 0;
    for (const auto& [a, b] : edges) {
      if (place_[a] == kNone) place_[a] = count++;
      if (place_[b] == kNone) place_[b] = count++;
    }
    triangles_.resize(count);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (place_[v] != kNone) triangles_[place_[v]].push_back(t);
      }
    }
  }
  [[nodiscard]] const std::vector<std::uint32_t>& of(std::uint32_t vertex) const {
    return triangles_[place_[vertex]];
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> place_;
  std::vector<std::vector<std::uint32_t>> triangles_;
};

/// The vertices joined to `v`, each as often as a triangle says so: twice, or once at the rim.
[[nodiscard]] inline std::vector<std::uint32_t> neighbours(const Mesh& mesh,
                                                           const Stars& stars,
                                                           std::uint32_t v) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : stars.of(v)) {
    for (const std::uint32_t other : mesh.triangles[t]) {
      if (other != v) found.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace frangia
