#include "frangia/geometry/boundary.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "frangia/core/pixel_buffer.h"

namespace frangia {
namespace {

constexpr std::uint32_t kNone = HalfEdges::kBoundary;

/// Returns the boundary edge that starts where `edge` ends, by rotating about that vertex.
std::uint32_t following(const HalfEdges& edges, std::uint32_t edge) {
  std::uint32_t turned = HalfEdges::next(edge);
  while (edges.has_twin(turned))
    turned = HalfEdges::next(edges.twin(turned));
  return edges.is_boundary(turned) ? turned : kNone;
}

void measure(const Mesh& mesh, BoundaryLoop& loop) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t edge : loop.edges) {
    const Eigen::Vector3f& from = mesh.vertices_mm[source_vertex(mesh, edge)];
    mean += from.cast<double>();
    loop.length_mm +=
        static_cast<double>((mesh.vertices_mm[target_vertex(mesh, edge)] - from).norm());
  }
  mean /= static_cast<double>(loop.edges.size());
  for (const std::uint32_t edge : loop.edges) {
    const Eigen::Vector3d from = mesh.vertices_mm[source_vertex(mesh, edge)].cast<double>();
    loop.size_mm = std::max(loop.size_mm, 2.0 * (from - mean).norm());
  }
}

}  // namespace

std::vector<BoundaryLoop> boundary_loops(const Mesh& mesh, const HalfEdges& edges) {
  std::vector<BoundaryLoop> loops;
  std::vector<bool> seen(edges.count());
  for (std::uint32_t first = 0; first < edges.count(); ++first) {
    if (seen[first] || !edges.is_boundary(first)) continue;
    BoundaryLoop loop;
    std::uint32_t edge = first;
    while (edge != kNone && !seen[edge]) {
      seen[edge] = true;
      loop.edges.push_back(edge);
      edge = following(edges, edge);
    }
    if (edge != first) continue;
    measure(mesh, loop);
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<BoundaryLoop> boundary_loops(const Mesh& mesh) {
  return boundary_loops(mesh, HalfEdges(mesh));
}

std::vector<std::uint32_t> vertices_of(const Mesh& mesh, const BoundaryLoop& loop) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(loop.edges.size());
  for (const std::uint32_t edge : loop.edges)
    vertices.push_back(source_vertex(mesh, edge));
  return vertices;
}

Selection select_loop(const Mesh& mesh, const BoundaryLoop& loop) {
  std::vector<std::uint8_t> on_loop(mesh.vertices_mm.size());
  for (const std::uint32_t vertex : vertices_of(mesh, loop))
    on_loop[vertex] = 1;
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    selection[i] = on_loop[a] | on_loop[b] | on_loop[c];
  }
  return selection;
}

namespace {

/// Hashes a vertex number (splitmix64), so that sums over different edges differ.
std::uint64_t hashed(std::uint32_t i) {
  std::uint64_t x = i + 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

// Around an inner vertex, each neighbour follows and precedes the vertex equally often, so the sum
// of the signed hashes is zero.
std::vector<bool> boundary_vertices(const Mesh& mesh) {
  LargeVector<std::uint64_t> balance(mesh.vertices_mm.size(), 0);
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint64_t, 3> number{hashed(t[0]), hashed(t[1]), hashed(t[2])};
    for (std::size_t i = 0; i < 3; ++i)
      balance[t[i]] += number[(i + 1) % 3] - number[(i + 2) % 3];
  }
  std::vector<bool> boundary(balance.size());
  for (std::size_t i = 0; i < boundary.size(); ++i)
    boundary[i] = balance[i] != 0;
  return boundary;
}

}  // namespace frangia
