#include "frangia/geometry/one_rings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// A small set of vertices.
class VertexSet {
 public:
  /// Adds a vertex; returns false if the set already contains it.
  bool add(std::uint32_t vertex) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    std::uint32_t& slot = slot_of(vertex);
    if (slot == vertex) return false;
    slot = vertex;
    ++count_;
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;

  [[nodiscard]] std::uint32_t& slot_of(std::uint32_t vertex) {
    const std::size_t mask = slots_.size() - 1;
    constexpr std::uint32_t kScramble = 0x9e3779b9U;
    std::size_t i = (vertex * kScramble >> 16U) & mask;
    while (slots_[i] != kNone && slots_[i] != vertex)
      i = (i + 1) & mask;
    return slots_[i];
  }
  void grow() {
    constexpr std::size_t kFirst = 256;
    std::vector<std::uint32_t> before(std::max(kFirst, 2 * slots_.size()), kNone);
    std::swap(before, slots_);
    for (const std::uint32_t vertex : before) {
      if (vertex != kNone) slot_of(vertex) = vertex;
    }
  }

  std::vector<std::uint32_t> slots_;  ///< a power of two, at most half of them used
  std::size_t count_ = 0;
};

/// Turns the counts in first[i + 1] into offsets.
void accumulate(LargeVector<std::uint32_t>& first) {
  for (std::size_t i = 1; i < first.size(); ++i)
    first[i] += first[i - 1];
}

constexpr std::uint32_t kNotCollected = ~0U;

}  // namespace

OneRings::OneRings(const Mesh& mesh) : first_(mesh.vertices_mm.size() + 1, 0) {
  for (const auto& t : mesh.triangles) {
    if (is_removed(t)) continue;
    for (const std::uint32_t v : t)
      ++first_[v + 1];
  }
  accumulate(first_);
  triangles_.resize(first_.back());
  LargeVector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_removed(mesh.triangles[t])) continue;
    for (const std::uint32_t v : mesh.triangles[t])
      triangles_[next[v]++] = t;
  }
}

OneRings::OneRings(const Mesh& mesh, std::span<const std::uint32_t> vertices)
    : ring_of_(mesh.vertices_mm.size(), kNotCollected) {
  std::uint32_t rings = 0;
  std::vector<std::uint64_t> bits((ring_of_.size() + 63) / 64, 0);  // fits into the cache
  for (const std::uint32_t v : vertices) {
    if (ring_of_[v] != kNotCollected) continue;
    ring_of_[v] = rings++;
    bits[v / 64] |= std::uint64_t{1} << (v % 64);
  }
  const auto is_collected = [&](std::uint32_t v) { return (bits[v / 64] >> (v % 64) & 1U) != 0; };
  constexpr std::size_t kTriangles = 65536;
  std::vector<std::vector<std::uint32_t>> parts((mesh.triangles.size() + kTriangles - 1) /
                                                kTriangles);
  parallel_chunks(mesh.triangles.size(), kTriangles, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if ((is_collected(a) || is_collected(b) || is_collected(c)) && !is_removed(mesh.triangles[t]))
        parts[begin / kTriangles].push_back(static_cast<std::uint32_t>(t));
    }
  });
  for (const auto& part : parts)
    selected_.insert(selected_.end(), part.begin(), part.end());
  first_.assign(rings + 1, 0);
  const auto for_each_corner = [&](const auto& visit) {
    for (const std::uint32_t t : selected_) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (ring_of_[v] != kNotCollected) visit(ring_of_[v], t);
      }
    }
  };
  for_each_corner([&](std::uint32_t ring, std::uint32_t /*t*/) { ++first_[ring + 1]; });
  accumulate(first_);
  triangles_.resize(first_.back());
  LargeVector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_corner([&](std::uint32_t ring, std::uint32_t t) { triangles_[next[ring]++] = t; });
}

std::vector<std::uint32_t> one_ring_neighbors(const Mesh& mesh,
                                              const OneRings& one_rings,
                                              std::uint32_t v) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : one_rings.of(v)) {
    for (const std::uint32_t other : mesh.triangles[t]) {
      if (other != v) found.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> vertices_within(
    const Mesh& mesh, const OneRings& one_rings, std::uint32_t vertex, int rings, float reach_mm) {
  std::vector<std::uint32_t> found{vertex};
  VertexSet known;
  known.add(vertex);
  std::size_t i = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = found.size();
    for (; i < end; ++i) {
      for (const std::uint32_t t : one_rings.of(found[i])) {
        for (const std::uint32_t v : mesh.triangles[t]) {
          const float square = (mesh.vertices_mm[v] - mesh.vertices_mm[vertex]).squaredNorm();
          if (square < reach_mm * reach_mm && known.add(v)) found.push_back(v);
        }
      }
    }
  }
  return found;
}

}  // namespace frangia
