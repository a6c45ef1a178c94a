#include "frangia/files/internal/weld_vertices.h"

#include <bit>
#include <limits>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/geometry/separate_shells.h"

namespace frangia {
namespace {

std::uint64_t hash_of(const Eigen::Vector3f& position) {
  std::uint64_t hash = 0;
  for (const float coordinate : position) {
    const auto bits = std::bit_cast<std::uint32_t>(coordinate + 0.0F);  // -0 is 0
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29U;
  }
  return hash;
}

/// Open-addressed hash table of vertices by position, at most half full.
class VertexTable {
 public:
  VertexTable(std::size_t max_count, std::vector<Eigen::Vector3f>& vertices)
      : slots_(std::bit_ceil(2 * max_count + 1), kFree), vertices_(vertices) {}

  std::uint32_t index_of(const Eigen::Vector3f& position) {
    std::size_t slot = hash_of(position) & (slots_.size() - 1);
    while (slots_[slot] != kFree && vertices_[slots_[slot]] != position)
      slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == kFree) {
      slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(position);
    }
    return slots_[slot];
  }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> slots_;
  std::vector<Eigen::Vector3f>& vertices_;
};

}  // namespace

Mesh weld_vertices(std::span<const Eigen::Vector3f> corners_mm) {
  require(corners_mm.size() % 3 == 0, "the number of corners must be a multiple of three");
  require(corners_mm.size() < std::numeric_limits<std::uint32_t>::max(),
          "the mesh has more than 4 billion corners; decimate it first");
  Mesh mesh;
  VertexTable table(corners_mm.size(), mesh.vertices_mm);
  mesh.triangles.reserve(corners_mm.size() / 3);
  for (std::size_t i = 0; i < corners_mm.size(); i += 3) {
    const std::uint32_t a = table.index_of(corners_mm[i]);
    const std::uint32_t b = table.index_of(corners_mm[i + 1]);
    const std::uint32_t c = table.index_of(corners_mm[i + 2]);
    if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
  }
  return separate_shells(std::move(mesh));
}

}  // namespace frangia
