#include "frangia/geometry/one_rings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace frangia {
namespace {

/// A few vertices, known by their numbers.
class VertexSet {
 public:
  /// Adds a vertex; false when it was there.
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

  std::vector<std::uint32_t> slots_;  ///< a power of two, at most half of them taken
  std::size_t count_ = 0;
};

}  // namespace

OneRings::OneRings(const Mesh& mesh) : first_(mesh.vertices_mm.size() + 1, 0) {
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v)
    first_[v] += first_[v - 1];
  triangles_.resize(3 * mesh.triangles.size());
  LargeVector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t])
      triangles_[next[v]++] = t;
  }
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
