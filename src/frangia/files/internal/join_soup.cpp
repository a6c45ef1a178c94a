#include "frangia/files/internal/join_soup.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/connectivity.h"

namespace frangia {
namespace {

constexpr std::size_t kSoupPerCheck = 1U << 16U;

/// A side of a triangle: 3 times the triangle and the corner that it begins at.
using Side = std::size_t;

std::uint32_t corner_at(const Mesh& mesh, Side side, std::size_t further) {
  return mesh.triangles[side / 3].at((side % 3 + further) % 3);
}

/// The first vertex at the place of each one.
std::vector<std::uint32_t> places_of(const Mesh& mesh) {
  constexpr std::uint32_t kFree = UINT32_MAX;
  const std::size_t slots = std::bit_ceil(2 * mesh.vertices_mm.size() + 1);
  std::vector<std::uint32_t> known(slots, kFree);
  std::vector<std::uint32_t> places(mesh.vertices_mm.size());
  for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
    std::uint64_t key = 0;
    for (const float coordinate : mesh.vertices_mm[vertex])
      key = hash(key, std::bit_cast<std::uint32_t>(coordinate + 0.0F));  // -0 is 0
    std::size_t slot = key & (slots - 1);
    while (known[slot] != kFree && mesh.vertices_mm[known[slot]] != mesh.vertices_mm[vertex])
      slot = (slot + 1) & (slots - 1);
    if (known[slot] == kFree) known[slot] = vertex;
    places[vertex] = known[slot];
  }
  return places;
}

/// The sides at each edge, one after the other: sorted by the ends' numbers.
struct SidesOfEdges {
  struct Entry {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    Side side = 0;
    bool upward = false;  ///< from the lower number to the higher one
  };
  std::vector<Entry> entries;

  SidesOfEdges(const Mesh& mesh, const std::vector<std::uint32_t>& number) {
    entries.reserve(3 * mesh.triangles.size());
    for (Side side = 0; side < 3 * mesh.triangles.size(); ++side) {
      const std::uint32_t a = number[corner_at(mesh, side, 0)];
      const std::uint32_t b = number[corner_at(mesh, side, 1)];
      if (a != b) entries.push_back({std::min(a, b), std::max(a, b), side, a < b});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& left, const Entry& right) {
      return std::tie(left.low, left.high, left.side) < std::tie(right.low, right.high, right.side);
    });
  }

  /// Calls `work(first, last)` for the entries of each edge.
  template <typename Work>
  void each(const Work& work) const {
    for (std::size_t first = 0; first < entries.size();) {
      std::size_t last = first;
      while (last < entries.size() && entries[last].low == entries[first].low &&
             entries[last].high == entries[first].high)
        ++last;
      work(first, last);
      first = last;
    }
  }
};

/// Which sides have no other triangle.
std::vector<std::uint8_t> lone_sides(const Mesh& mesh) {
  std::vector<std::uint32_t> own(mesh.vertices_mm.size());
  std::iota(own.begin(), own.end(), 0U);
  const SidesOfEdges sides(mesh, own);
  std::vector<std::uint8_t> lone(3 * mesh.triangles.size());
  sides.each([&](std::size_t first, std::size_t last) {
    if (last - first == 1) lone[sides.entries[first].side] = 1;
  });
  return lone;
}

/// The triangles that share vertices, by the number of a triangle.
DisjointSets sharing_triangles(const Mesh& mesh) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  DisjointSets shells(mesh.triangles.size());
  std::vector<std::uint32_t> first(mesh.vertices_mm.size(), kNone);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (first[vertex] == kNone) first[vertex] = i;
      shells.join(first[vertex], i);
    }
  }
  return shells;
}

/// Pairs the sides of each edge: those of one shell, and what touches there as it encloses
/// material.
std::vector<Side> partners_of(const Mesh& mesh, const SidesOfEdges& sides, const Run& run) {
  std::vector<Side> partner(3 * mesh.triangles.size(), kNoPartner);
  DisjointSets shells = sharing_triangles(mesh);
  sides.each([&](std::size_t first, std::size_t last) {
    const SidesOfEdges::Entry& a = sides.entries[first];
    const SidesOfEdges::Entry& b = sides.entries[last - 1];
    if (last - first != 2 || a.upward == b.upward) return;
    partner[a.side] = b.side;
    partner[b.side] = a.side;
    shells.join(static_cast<std::uint32_t>(a.side / 3), static_cast<std::uint32_t>(b.side / 3));
  });
  const bool inside_out = is_inside_out(mesh);
  std::vector<EdgeSide> at_edge;
  sides.each([&](std::size_t first, std::size_t last) {
    if (first % kSoupPerCheck == 0) run.check();
    if (last - first < 3) return;
    at_edge.clear();
    for (std::size_t i = first; i < last; ++i) {
      const SidesOfEdges::Entry& entry = sides.entries[i];
      at_edge.push_back({mesh.vertices_mm[corner_at(mesh, entry.side, 2)].cast<double>(),
                         entry.upward != inside_out,
                         shells.find(static_cast<std::uint32_t>(entry.side / 3))});
    }
    const std::vector<std::size_t> pairs =
        pair_sides(mesh.vertices_mm[sides.entries[first].low].cast<double>(),
                   mesh.vertices_mm[sides.entries[first].high].cast<double>(),
                   at_edge);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const bool opposite = pairs[i] != kNoPartner && at_edge[i].upward != at_edge[pairs[i]].upward;
      if (opposite) partner[sides.entries[first + i].side] = sides.entries[first + pairs[i]].side;
    }
  });
  return partner;
}

/// Whether two vertices of one place may become one.
bool have_equal_values(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  const auto equal = [&](const auto& values) { return values.empty() || values[a] == values[b]; };
  return equal(mesh.colors) && equal(mesh.sigma_mm) && equal(mesh.sigma_noise_mm) &&
         equal(mesh.sigma_systematic_mm) && equal(mesh.views) && equal(mesh.vertex_marks);
}

/// Keeps the values of the vertices that `kept` lists.
template <typename Value>
void keep(std::vector<Value>& values, const std::vector<std::uint32_t>& kept) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i)
    values[i] = values[kept[i]];  // `kept` rises
  values.resize(kept.size());
}

}  // namespace

Mesh join_soup(Mesh mesh, const std::filesystem::path& path, const Run& run) {
  if (mesh.triangles.size() < 2) return mesh;
  const std::vector<std::uint32_t> places = places_of(mesh);
  bool repeats = false;
  for (std::uint32_t vertex = 0; vertex < places.size() && !repeats; ++vertex)
    repeats = places[vertex] != vertex;
  if (!repeats) return mesh;
  run.check();
  const std::vector<std::uint8_t> lone = lone_sides(mesh);
  // Of n triangles with shared vertices, few sides are alone.
  const auto alone = static_cast<std::size_t>(std::count(lone.begin(), lone.end(), 1));
  const bool is_soup = 2 * alone > 3 * mesh.triangles.size();
  SidesOfEdges sides(mesh, places);
  if (!is_soup) {
    std::erase_if(sides.entries,
                  [&](const SidesOfEdges::Entry& entry) { return lone[entry.side] == 0; });
  }
  run.check();
  const std::vector<Side> partner = partners_of(mesh, sides, run);
  DisjointSets joined(mesh.vertices_mm.size());
  bool normals_differ = false;
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b || !have_equal_values(mesh, a, b)) return;
    normals_differ =
        normals_differ || (!mesh.normals.empty() && mesh.normals[a] != mesh.normals[b]);
    joined.join(a, b);
  };
  for (Side side = 0; side < partner.size(); ++side) {
    if (partner[side] == kNoPartner || partner[side] < side) continue;
    join(corner_at(mesh, side, 0), corner_at(mesh, partner[side], 1));
    join(corner_at(mesh, side, 1), corner_at(mesh, partner[side], 0));
  }
  std::vector<std::uint32_t> number(mesh.vertices_mm.size());
  std::vector<std::uint32_t> kept;
  for (std::uint32_t vertex = 0; vertex < number.size(); ++vertex) {
    const std::uint32_t first = joined.find(vertex);
    if (first == vertex) {
      number[vertex] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(vertex);
    } else {
      number[vertex] = number[first];
    }
  }
  if (kept.size() == number.size()) return mesh;
  for (Mesh::Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle)
      corner = number[corner];
  if (normals_differ) mesh.normals.clear();
  keep(mesh.vertices_mm, kept);
  keep(mesh.normals, kept);
  keep(mesh.colors, kept);
  keep(mesh.sigma_mm, kept);
  keep(mesh.sigma_noise_mm, kept);
  keep(mesh.sigma_systematic_mm, kept);
  keep(mesh.views, kept);
  keep(mesh.vertex_marks, kept);
  run.warn(fmt::format(
      "{}: {}; {} vertices were joined to {} where edges meet",
      path.string(),
      is_soup ? "its faces have vertices of their own"
              : "its vertices stand twice where faces meet, as at seams of normals or textures",
      number.size(),
      kept.size()));
  return mesh;
}

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
