#include "frangia/geometry/connectivity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kEdgesPerChunk = 16'384;

/// Finds half-edges by their ends. A vertex of high valence gets its outgoing half-edges sorted by
/// target, so that a search there does not visit all of them.
class EdgeFinder {
 public:
  EdgeFinder(const Mesh& mesh, const HalfEdges& edges) : mesh_(mesh), edges_(edges) {
    for (std::uint32_t v = 0; v < mesh.vertices_mm.size(); ++v) {
      if (edges.outgoing(v).size() <= kLinearSearch) continue;
      std::vector<std::uint32_t>& sorted = sorted_[v];
      sorted.assign(edges.outgoing(v).begin(), edges.outgoing(v).end());
      std::stable_sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        return target_vertex(mesh, a) < target_vertex(mesh, b);
      });
    }
  }

  struct Matches {
    std::uint32_t first = 0;  ///< undefined without a match
    std::size_t count = 0;
  };
  [[nodiscard]] Matches find(std::uint32_t from, std::uint32_t to) const {
    Matches matches;
    const std::span<const std::uint32_t> outgoing = edges_.outgoing(from);
    if (outgoing.size() > kLinearSearch) {
      const std::vector<std::uint32_t>& sorted = sorted_.at(from);
      const auto begin = std::partition_point(sorted.begin(), sorted.end(), [&](std::uint32_t e) {
        return target_vertex(mesh_, e) < to;
      });
      const auto end = std::partition_point(
          begin, sorted.end(), [&](std::uint32_t e) { return target_vertex(mesh_, e) == to; });
      matches.count = static_cast<std::size_t>(end - begin);
      if (begin != end) matches.first = *begin;
      return matches;
    }
    for (const std::uint32_t edge : outgoing) {
      if (target_vertex(mesh_, edge) == to && matches.count++ == 0) matches.first = edge;
    }
    return matches;
  }

 private:
  static constexpr std::size_t kLinearSearch = 32;  // half-edges; a typical valence is 6
  const Mesh& mesh_;
  const HalfEdges& edges_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> sorted_;
};

}  // namespace

HalfEdges::HalfEdges(const Mesh& mesh) {
  require(mesh.triangles.size() < kNonManifold / 3,
          "HalfEdges: more than 1.4 billion triangles; decimate the mesh first");
  const std::size_t vertices = mesh.vertices_mm.size();
  first_.assign(vertices + 1, 0);
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    require(std::max({triangle[0], triangle[1], triangle[2]}) < vertices,
            "HalfEdges: a triangle refers to a vertex that does not exist; repair the mesh first");
    for (const std::uint32_t vertex : triangle)
      ++first_[vertex + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v)
    first_[v] += first_[v - 1];
  const std::size_t edges = 3 * mesh.triangles.size();
  edges_.resize(edges);
  twins_.resize(edges);
  for (std::uint32_t e = 0; e < edges; ++e)
    edges_[first_[source_vertex(mesh, e)]++] = e;
  for (std::size_t v = vertices; v > 0; --v)
    first_[v] = first_[v - 1];
  first_[0] = 0;
  const EdgeFinder finder(mesh, *this);
  parallel_chunks(edges, kEdgesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto edge = static_cast<std::uint32_t>(i);
      const std::uint32_t from = source_vertex(mesh, edge);
      const std::uint32_t to = target_vertex(mesh, edge);
      const EdgeFinder::Matches opposite = finder.find(to, from);
      const bool manifold = from != to && opposite.count <= 1 && finder.find(from, to).count == 1;
      const std::uint32_t twin = opposite.count == 0 ? kBoundary : opposite.first;
      twins_[i] = manifold ? twin : kNonManifold;
    }
  });
}

namespace {

/// The angle of a triangle about its edge from a direction across the edge, in small steps.
std::int64_t angle_about_edge(const Eigen::Vector3d& way,
                              const Eigen::Vector3d& along,
                              const Eigen::Vector3d& across) {
  const double angle_rad = std::atan2(along.cross(across).dot(way), across.dot(way));
  constexpr double kStep_rad = 1e-6;  // faces in one plane are at one angle, also at half a turn
  constexpr double kPi_rad = 3.14159265358979323846;
  return angle_rad < kStep_rad - kPi_rad ? std::llround(kPi_rad / kStep_rad)
                                         : std::llround(angle_rad / kStep_rad);
}

}  // namespace

bool is_inside_out(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices_mm[mesh.triangles[0][0]].cast<double>();
    const auto from_origin = [&](std::uint32_t vertex) -> Eigen::Vector3d {
      return mesh.vertices_mm[vertex].cast<double>() - origin;
    };
    volume += from_origin(a).dot(from_origin(b).cross(from_origin(c)));
  }
  return volume < 0.0;
}

std::vector<std::size_t> pair_sides(const Eigen::Vector3d& first_end_mm,
                                    const Eigen::Vector3d& second_end_mm,
                                    std::span<const EdgeSide> sides) {
  std::vector<std::size_t> partner(sides.size(), kNoPartner);
  const auto connect = [&](std::size_t a, std::size_t b) {
    partner[a] = b;
    partner[b] = a;
  };
  const Eigen::Vector3d along = (second_end_mm - first_end_mm).normalized();
  const Eigen::Vector3d across = along.unitOrthogonal();
  struct Turned {
    std::int64_t angle;
    std::size_t side;
  };
  std::vector<Turned> turned;
  for (std::size_t i = 0; i < sides.size(); ++i)
    turned.push_back({angle_about_edge(sides[i].apex_mm - first_end_mm, along, across), i});
  std::stable_sort(turned.begin(), turned.end(), [&](const Turned& a, const Turned& b) {
    return sides[a.side].shell < sides[b.side].shell;
  });
  for (std::size_t begin = 0; begin < turned.size();) {
    std::size_t end = begin;
    while (end < turned.size() && sides[turned[end].side].shell == sides[turned[begin].side].shell)
      ++end;
    // A triangle and its back, which run together, are no pair.
    if (end - begin == 2 && turned[begin].angle != turned[begin + 1].angle)
      connect(turned[begin].side, turned[begin + 1].side);
    begin = end;
  }
  std::erase_if(turned, [&](const Turned& one) { return partner[one.side] != kNoPartner; });
  std::sort(turned.begin(), turned.end(), [&](const Turned& a, const Turned& b) {
    // At one angle an upward side comes first: bodies that touch with a face stay apart.
    return std::tuple(a.angle, !sides[a.side].upward, a.side) <
           std::tuple(b.angle, !sides[b.side].upward, b.side);
  });
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const std::size_t down = turned[i].side;
    const std::size_t up = turned[(i + 1) % turned.size()].side;
    if (!sides[down].upward && sides[up].upward) connect(down, up);
  }
  return partner;
}

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
