#include "frangia/files/internal/join_soup.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr std::size_t kNoPartner = SIZE_MAX;
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

/// The angle of a side's triangle about its edge from a direction across the edge, in small steps.
std::int64_t angle_about_edge(const Mesh& mesh,
                              const SidesOfEdges::Entry& entry,
                              const Eigen::Vector3d& origin,
                              const Eigen::Vector3d& along,
                              const Eigen::Vector3d& across) {
  const Eigen::Vector3d way =
      mesh.vertices_mm[corner_at(mesh, entry.side, 2)].cast<double>() - origin;
  const double angle_rad = std::atan2(along.cross(across).dot(way), across.dot(way));
  constexpr double kStep_rad = 1e-6;  // faces in one plane are at one angle, also at half a turn
  constexpr double kPi_rad = 3.14159265358979323846;
  return angle_rad < kStep_rad - kPi_rad ? std::llround(kPi_rad / kStep_rad)
                                         : std::llround(angle_rad / kStep_rad);
}

/// Pairs the sides of one edge that enclose material: behind an upward side, against the sense of
/// rotation, comes the next downward one.
void pair_sides(const Mesh& mesh,
                std::span<const SidesOfEdges::Entry> at_edge,
                std::vector<Side>& partner) {
  const auto connect = [&](Side a, Side b) {
    partner[a] = b;
    partner[b] = a;
  };
  if (at_edge.size() == 2) {
    if (at_edge[0].upward != at_edge[1].upward) connect(at_edge[0].side, at_edge[1].side);
    return;
  }
  const Eigen::Vector3d origin = mesh.vertices_mm[at_edge[0].low].cast<double>();
  const Eigen::Vector3d along =
      (mesh.vertices_mm[at_edge[0].high].cast<double>() - origin).normalized();
  const Eigen::Vector3d across = along.unitOrthogonal();
  struct Turned {
    std::int64_t angle;
    const SidesOfEdges::Entry* entry;
  };
  std::vector<Turned> turned;
  for (const SidesOfEdges::Entry& entry : at_edge)
    turned.push_back({angle_about_edge(mesh, entry, origin, along, across), &entry});
  std::sort(turned.begin(), turned.end(), [](const Turned& a, const Turned& b) {
    // At one angle an upward side comes first: bodies that touch with a face stay apart.
    return std::tuple(a.angle, !a.entry->upward, a.entry->side) <
           std::tuple(b.angle, !b.entry->upward, b.entry->side);
  });
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const SidesOfEdges::Entry& down = *turned[i].entry;
    const SidesOfEdges::Entry& up = *turned[(i + 1) % turned.size()].entry;
    if (!down.upward && up.upward) connect(down.side, up.side);
  }
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
  std::vector<Side> partner(3 * mesh.triangles.size(), kNoPartner);
  sides.each([&](std::size_t first, std::size_t last) {
    if (first % kSoupPerCheck == 0) run.check();
    if (last - first > 1)
      pair_sides(mesh, std::span(sides.entries).subspan(first, last - first), partner);
  });
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

}  // namespace frangia
