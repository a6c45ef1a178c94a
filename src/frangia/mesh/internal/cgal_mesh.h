#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/mesh/internal/steps_per_check.h"

namespace frangia {

/// Converts a mesh to CGAL's, with vertices and faces in the same order; nullopt for a mesh that is
/// not manifold. Only for sources behind FRANGIA_WITH_CGAL.
///
/// @errors   Error(Cancelled)
template <typename Surface>
[[nodiscard]] std::optional<Surface> to_cgal(const Mesh& mesh, const Run& run = {}) {
  Surface surface;
  std::vector<typename Surface::Vertex_index> ids;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm) {
    const Eigen::Vector3d p = vertex.cast<double>();
    ids.push_back(surface.add_vertex(typename Surface::Point(p.x(), p.y(), p.z())));
    if (ids.size() % kStepsPerCheck == 0) run.check();
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % kStepsPerCheck == 0) run.check();
    const auto& [a, b, c] = mesh.triangles[t];
    if (surface.add_face(ids[a], ids[b], ids[c]) == Surface::null_face()) return std::nullopt;
  }
  return surface;
}

/// Converts CGAL's mesh back, without the elements that were removed from it.
///
/// @errors   Error(Cancelled)
template <typename Surface>
[[nodiscard]] Mesh from_cgal(const Surface& surface, const Run& run = {}) {
  Mesh mesh;
  std::vector<std::uint32_t> number(surface.num_vertices() + surface.number_of_removed_vertices());
  for (const auto id : surface.vertices()) {
    number[id.idx()] = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    const auto& p = surface.point(id);
    mesh.vertices_mm.emplace_back(Eigen::Vector3d(p.x(), p.y(), p.z()).template cast<float>());
    if (mesh.vertices_mm.size() % kStepsPerCheck == 0) run.check();
  }
  for (const auto face : surface.faces()) {
    Mesh::Triangle triangle{};
    std::size_t corner = 0;
    for (const auto id : surface.vertices_around_face(surface.halfedge(face)))
      triangle.at(corner++) = number[id.idx()];
    mesh.triangles.push_back(triangle);
    if (mesh.triangles.size() % kStepsPerCheck == 0) run.check();
  }
  return mesh;
}

}  // namespace frangia
