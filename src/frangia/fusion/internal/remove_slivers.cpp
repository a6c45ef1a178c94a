#include "frangia/fusion/internal/remove_slivers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/normal_agreement.h"
#include "frangia/geometry/connectivity.h"

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

namespace {

void add(SplitTriangle& t, std::size_t a, std::size_t b, std::size_t c) {
  t.pieces[t.count++] = {
      static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)};
}

/// Cuts off the corner between two points, and the remaining quad along its shorter diagonal.
void cut_corner(SplitTriangle& t, std::size_t corner) {
  const std::size_t next = (corner + 1) % 3;
  const std::size_t last = (corner + 2) % 3;
  const std::size_t after = 3 + corner;
  const std::size_t before = 3 + last;
  add(t, before, corner, after);
  const float one = (t.points[last] - t.points[after]).squaredNorm();
  const float other = (t.points[next] - t.points[before]).squaredNorm();
  if (one < other) {
    add(t, last, before, after);
    add(t, last, after, next);
  } else {
    add(t, last, before, next);
    add(t, next, before, after);
  }
}

}  // namespace

void triangulate(SplitTriangle& t) {
  t.count = 0;
  if (t.split == 0) return add(t, 0, 1, 2);
  const int points = std::popcount(t.split);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const std::size_t last = (i + 2) % 3;
    const bool here = (t.split >> i & 1U) != 0;
    if (points == 1 && here) {
      add(t, i, 3 + i, last);
      add(t, 3 + i, next, last);
    }
    if (points == 2 && !here) cut_corner(t, last);
    if (points == 3) {
      add(t, 6, i, 3 + i);
      add(t, 6, 3 + i, next);
    }
  }
}

namespace {

using Vertex = std::uint32_t;
using Edge = std::pair<Vertex, Vertex>;

/// Returns the short edges of the candidates, each once, in ascending order.
std::vector<Edge> short_edges(const Mesh& mesh,
                              const std::vector<std::uint32_t>& near,
                              float shortest_mm) {
  std::vector<Edge> edges;
  for (const std::uint32_t t : near) {
    if (is_removed(mesh.triangles[t])) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vertex a = mesh.triangles[t][i];
      const Vertex b = mesh.triangles[t][(i + 1) % 3];
      const float squared = (mesh.vertices_mm[a] - mesh.vertices_mm[b]).squaredNorm();
      if (squared < shortest_mm * shortest_mm) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Whether the mesh stays manifold when a and b collapse: they share as many neighbours as
/// triangles, and an inner edge does not connect two boundary vertices.
///
/// @source   the link condition, Dey et al. 1999
bool satisfies_link_condition(std::vector<Vertex> of_a, std::vector<Vertex> of_b, Vertex b) {
  const auto triangles = std::count(of_a.begin(), of_a.end(), b);
  const auto on_boundary = [](const std::vector<Vertex>& sorted) {
    for (std::size_t i = 0; i < sorted.size(); i += 2) {
      if (i + 1 == sorted.size() || sorted[i] != sorted[i + 1]) return true;
    }
    return false;
  };
  if (triangles == 2 && on_boundary(of_a) && on_boundary(of_b)) return false;
  of_a.erase(std::unique(of_a.begin(), of_a.end()), of_a.end());
  of_b.erase(std::unique(of_b.begin(), of_b.end()), of_b.end());
  std::vector<Vertex> shared;
  std::set_intersection(
      of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(shared));
  return std::ssize(shared) == triangles;
}

/// Whether the triangles around the first vertex that do not contain the second one still face
/// outward with the first vertex at `point`.
bool keeps_orientation(const Mesh& mesh,
                       const OneRings& one_rings,
                       const Edge& ends,
                       const Eigen::Vector3f& point,
                       float turn_cosine) {
  const auto& [v, other] = ends;
  for (const std::uint32_t t : one_rings.of(v)) {
    Mesh::Triangle corners = mesh.triangles[t];
    if (has_vertex(corners, other)) continue;
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), v), corners.end());
    const Eigen::Vector3f& b = mesh.vertices_mm[corners[1]];
    const Eigen::Vector3f& c = mesh.vertices_mm[corners[2]];
    const Eigen::Vector3f outward =
        mesh.normals[corners[0]] + mesh.normals[corners[1]] + mesh.normals[corners[2]];
    const Eigen::Vector3f before = (b - mesh.vertices_mm[v]).cross(c - mesh.vertices_mm[v]);
    if (before.dot(outward) <= 0.0F) continue;  // it faces inward already
    const Eigen::Vector3f after = (b - point).cross(c - point);
    if (after.dot(outward) <= 0.0F ||
        after.dot(before) < turn_cosine * after.norm() * before.norm()) {
      return false;
    }
  }
  return true;
}

/// Collapses a set of edges that do not share neighbours. Returns whether any was collapsed.
bool collapse_once(Mesh& mesh,
                   std::span<const std::uint8_t> sharp,
                   float shortest_mm,
                   SliverCandidates& candidates,
                   float turn_cosine) {
  const std::vector<Edge> edges = short_edges(mesh, candidates.triangles(), shortest_mm);
  if (edges.empty()) return false;
  std::vector<Vertex> ends;
  for (const auto& [a, b] : edges)
    ends.insert(ends.end(), {a, b});
  const OneRings one_rings(mesh, ends);
  std::vector<bool> touched(mesh.vertices_mm.size(), false);
  const auto sharpness = [&](Vertex v) { return v < sharp.size() ? sharp[v] : std::uint8_t{0}; };
  bool any = false;
  for (auto [a, b] : edges) {
    if (sharpness(a) < sharpness(b)) std::swap(a, b);
    const std::vector<Vertex> of_a = one_ring_neighbors(mesh, one_rings, a);
    const std::vector<Vertex> of_b = one_ring_neighbors(mesh, one_rings, b);
    const auto is_touched = [&](Vertex v) { return touched[v]; };
    if (std::any_of(of_a.begin(), of_a.end(), is_touched) ||
        std::any_of(of_b.begin(), of_b.end(), is_touched) ||
        !satisfies_link_condition(of_a, of_b, b)) {
      continue;
    }
    const bool same_kind = sharpness(a) == sharpness(b);
    const Eigen::Vector3f point =
        same_kind ? Eigen::Vector3f(0.5F * (mesh.vertices_mm[a] + mesh.vertices_mm[b]))
                  : mesh.vertices_mm[a];
    if (!keeps_orientation(mesh, one_rings, {a, b}, point, turn_cosine) ||
        !keeps_orientation(mesh, one_rings, {b, a}, point, turn_cosine))
      continue;
    mesh.vertices_mm[a] = point;
    for (const std::uint32_t t : one_rings.of(b)) {
      auto& triangle = mesh.triangles[t];
      if (has_vertex(triangle, a)) {
        triangle = {};
      } else {
        std::replace(triangle.begin(), triangle.end(), b, a);
      }
    }
    for (const auto* around : {&of_a, &of_b}) {
      for (const Vertex v : *around)
        touched[v] = true;
    }
    any = true;
  }
  candidates.add(one_rings.selected_triangles());
  return any;
}

}  // namespace

bool collapse_slivers(Mesh& mesh,
                      std::span<const std::uint8_t> sharp,
                      float shortest_mm,
                      SliverCandidates& candidates,
                      const CleanupParameters& parameters) {
  constexpr int kPasses = 2;
  const auto turn_cosine = static_cast<float>(std::cos(parameters.collapse_turn_rad));
  bool any = false;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!collapse_once(mesh, sharp, shortest_mm, candidates, turn_cosine)) break;
    any = true;
  }
  return any;
}

namespace {

using Vertex = std::uint32_t;

float height_of(const Mesh& mesh, const Mesh::Triangle& t) {
  float longest = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, (mesh.vertices_mm[t[(i + 1) % 3]] - mesh.vertices_mm[t[i]]).norm());
  }
  return longest > 0.0F ? doubled_area_vector(mesh, t).norm() / longest : 0.0F;
}

/// A low triangle a, b, c, rotated so that a-b is its longest edge.
struct Cap {
  std::uint32_t triangle;
  Vertex a, b, c;
};

std::vector<Cap> find_caps(const Mesh& mesh,
                           const std::vector<std::uint32_t>& near,
                           float lowest_mm) {
  std::vector<Cap> caps;
  for (const std::uint32_t t : near) {
    const auto& corners = mesh.triangles[t];
    if (is_removed(corners) || !is_low(mesh, corners, lowest_mm)) continue;
    std::array<float, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
      lengths[i] =
          (mesh.vertices_mm[corners[(i + 1) % 3]] - mesh.vertices_mm[corners[i]]).squaredNorm();
    }
    const auto longest = static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) -
                                                  lengths.begin());
    caps.push_back({t, corners[longest], corners[(longest + 1) % 3], corners[(longest + 2) % 3]});
  }
  return caps;
}

/// Returns the triangle on the other side of the cap's longest edge; the cap itself at the
/// boundary.
std::uint32_t across(const Mesh& mesh, const OneRings& one_rings, const Cap& cap) {
  for (const std::uint32_t t : one_rings.of(cap.a)) {
    if (t != cap.triangle && has_vertex(mesh.triangles[t], cap.b)) return t;
  }
  return cap.triangle;
}

Vertex opposite(const Mesh::Triangle& t, const Cap& cap) {
  for (const Vertex v : t) {
    if (v != cap.a && v != cap.b) return v;
  }
  return cap.c;
}

}  // namespace

bool flip_caps(Mesh& mesh, float lowest_mm, SliverCandidates& candidates) {
  const std::vector<Cap> caps = find_caps(mesh, candidates.triangles(), lowest_mm);
  if (caps.empty()) return false;
  std::vector<Vertex> corners;
  for (const Cap& cap : caps)
    corners.insert(corners.end(), {cap.a, cap.b, cap.c});
  const OneRings one_rings(mesh, corners);
  std::vector<bool> touched(mesh.vertices_mm.size(), false);
  bool any = false;
  for (const Cap& cap : caps) {
    const std::uint32_t other = across(mesh, one_rings, cap);
    if (other == cap.triangle) continue;
    const Vertex d = opposite(mesh.triangles[other], cap);
    const auto joins = [&](std::uint32_t t) { return has_vertex(mesh.triangles[t], d); };
    if (touched[cap.a] || touched[cap.b] || touched[cap.c] || touched[d] ||
        std::any_of(one_rings.of(cap.c).begin(), one_rings.of(cap.c).end(), joins)) {
      continue;
    }
    const Mesh::Triangle one{cap.a, d, cap.c};
    const Mesh::Triangle two{d, cap.b, cap.c};
    const float now = std::min(normal_agreement(mesh, mesh.triangles[cap.triangle], -1.0F),
                               normal_agreement(mesh, mesh.triangles[other], -1.0F));
    const float then =
        std::min(normal_agreement(mesh, one, -1.0F), normal_agreement(mesh, two, -1.0F));
    const float lower = std::min(height_of(mesh, one), height_of(mesh, two));
    if (then <= now || lower <= height_of(mesh, mesh.triangles[cap.triangle])) continue;
    mesh.triangles[cap.triangle] = one;
    mesh.triangles[other] = two;
    for (const Vertex v : {cap.a, cap.b, cap.c, d})
      touched[v] = true;
    any = true;
  }
  candidates.add(one_rings.selected_triangles());
  return any;
}

void remove_slivers(Mesh& mesh,
                    std::span<const std::uint8_t> sharp,
                    float lowest_mm,
                    const CleanupParameters& parameters) {
  const float shortest_mm = 2.0F * lowest_mm;
  SliverCandidates candidates(mesh, shortest_mm, lowest_mm);
  constexpr int kMostPasses = 3;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const bool collapsed = collapse_slivers(mesh, sharp, shortest_mm, candidates, parameters);
    const bool flipped = flip_caps(mesh, lowest_mm, candidates);
    if (!collapsed && !flipped) break;
  }
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), is_removed),
                       mesh.triangles.end());
}

}  // namespace frangia
