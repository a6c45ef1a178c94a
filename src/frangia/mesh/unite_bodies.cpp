// CGAL is heavy to compile: it stays in this source.
#include "frangia/mesh/unite_bodies.h"

#ifdef FRANGIA_WITH_CGAL
#include <cstdint>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include "frangia/mesh/ray_scene.h"
#include "frangia/mesh/take_vertex_data.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using VertexId = Surface::Vertex_index;

/// Nothing when the mesh is not manifold.
std::optional<Surface> surface_of(const Mesh& mesh) {
  Surface surface;
  std::vector<VertexId> ids;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm) {
    const Eigen::Vector3d p = vertex.cast<double>();
    ids.push_back(surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surface.add_face(ids[a], ids[b], ids[c]) == Surface::null_face()) return std::nullopt;
  }
  return surface;
}

Mesh mesh_of(Surface& surface) {
  surface.collect_garbage();
  Mesh mesh;
  for (const VertexId id : surface.vertices()) {
    const auto& p = surface.point(id);
    mesh.vertices_mm.push_back(Eigen::Vector3d(p.x(), p.y(), p.z()).cast<float>());
  }
  for (const auto face : surface.faces()) {
    Mesh::Triangle triangle{};
    std::size_t corner = 0;
    for (const VertexId id : surface.vertices_around_face(surface.halfedge(face)))
      triangle.at(corner++) = id;
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

std::optional<Mesh> unite_bodies(const Mesh& a, const Mesh& b) {
  std::optional<Surface> of_a = surface_of(a);
  std::optional<Surface> of_b = surface_of(b);
  if (!of_a || !of_b || !CGAL::is_closed(*of_a) || !CGAL::is_closed(*of_b)) return std::nullopt;
  Surface both;
  try {
    if (!pmp::corefine_and_compute_union(
            *of_a, *of_b, both, pmp::parameters::throw_on_self_intersection(true))) {
      return std::nullopt;
    }
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    return std::nullopt;
  }
  Mesh united = mesh_of(both);
  Mesh source = a;
  append_mesh(source, b);
  take_vertex_data(united, RayScene(std::move(source)));
  return united;
}

}  // namespace frangia
#else
namespace frangia {

std::optional<Mesh> unite_bodies(const Mesh& /*a*/, const Mesh& /*b*/) {
  return std::nullopt;
}

}  // namespace frangia
#endif
