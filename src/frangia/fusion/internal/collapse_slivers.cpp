#include "frangia/fusion/internal/collapse_slivers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/one_rings.h"

namespace frangia {
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

}  // namespace frangia
