#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A mesh as CGAL's, with the same vertices and faces in the same order; nothing when it is not
/// manifold. Only for sources that stand behind FRANGIA_WITH_CGAL.
template <typename Surface>
[[nodiscard]] std::optional<Surface> to_cgal(const Mesh& mesh) {
  Surface surface;
  std::vector<typename Surface::Vertex_index> ids;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm) {
    const Eigen::Vector3d p = vertex.cast<double>();
    ids.push_back(surface.add_vertex(typename Surface::Point(p.x(), p.y(), p.z())));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surface.add_face(ids[a], ids[b], ids[c]) == Surface::null_face()) return std::nullopt;
  }
  return surface;
}

/// Places and triangles of a CGAL mesh, without what was removed from it.
template <typename Surface>
[[nodiscard]] Mesh from_cgal(const Surface& surface) {
  Mesh mesh;
  std::vector<std::uint32_t> number(surface.num_vertices() + surface.number_of_removed_vertices());
  for (const auto id : surface.vertices()) {
    number[id.idx()] = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    const auto& p = surface.point(id);
    mesh.vertices_mm.emplace_back(Eigen::Vector3d(p.x(), p.y(), p.z()).template cast<float>());
  }
  for (const auto face : surface.faces()) {
    Mesh::Triangle triangle{};
    std::size_t corner = 0;
    for (const auto id : surface.vertices_around_face(surface.halfedge(face)))
      triangle.at(corner++) = number[id.idx()];
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace frangia
