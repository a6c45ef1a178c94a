#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/core/pixel_allocator.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

[[nodiscard]] inline bool has_vertex(const Mesh::Triangle& t, std::uint32_t vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Whether a triangle was taken away, but not yet from the mesh's list.
[[nodiscard]] inline bool is_removed(const Mesh::Triangle& t) {
  return t[0] == t[1];
}

/// The triangles around the ends of some edges.
class SelectedOneRings {
 public:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  SelectedOneRings(const Mesh& mesh, const std::vector<Edge>& edges)
      : place_(mesh.vertices_mm.size(), kNone) {
    std::uint32_t count = 0;
    std::vector<std::uint64_t> marks((place_.size() + 63) / 64, 0);  // fit the processor's cache
    for (const auto& edge : edges) {
      for (const std::uint32_t v : {edge.first, edge.second}) {
        if (place_[v] != kNone) continue;
        place_[v] = count++;
        marks[v / 64] |= std::uint64_t{1} << (v % 64);
      }
    }
    const auto is_marked = [&](std::uint32_t v) { return (marks[v / 64] >> (v % 64) & 1U) != 0; };
    constexpr std::size_t kChunk = 65536;
    std::vector<std::vector<std::uint32_t>> parts((mesh.triangles.size() + kChunk - 1) / kChunk);
    parallel_chunks(mesh.triangles.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if ((is_marked(a) || is_marked(b) || is_marked(c)) && !is_removed(mesh.triangles[t]))
          parts[begin / kChunk].push_back(static_cast<std::uint32_t>(t));
      }
    });
    around_.resize(count);
    for (const auto& part : parts) {
      triangles_.insert(triangles_.end(), part.begin(), part.end());
      for (const std::uint32_t t : part) {
        for (const std::uint32_t v : mesh.triangles[t]) {
          if (place_[v] != kNone) around_[place_[v]].push_back(t);
        }
      }
    }
  }
  /// Of all of them, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<std::uint32_t>& of(std::uint32_t vertex) const {
    return around_[place_[vertex]];
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;
  LargeVector<std::uint32_t> place_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::vector<std::uint32_t>> around_;
};

/// The vertices joined to `v`, each as often as a triangle says so: twice, or once at the rim.
[[nodiscard]] inline std::vector<std::uint32_t> one_ring_neighbors(
    const Mesh& mesh, const SelectedOneRings& one_rings, std::uint32_t v) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : one_rings.of(v)) {
    for (const std::uint32_t other : mesh.triangles[t]) {
      if (other != v) found.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace frangia
