// CGAL is heavy to compile: it stays in this source.
#include "frangia/core/error.h"
#include "frangia/mesh/hole_patch.h"

#ifdef FRANGIA_WITH_CGAL
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>

namespace frangia {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using VertexId = Surface::Vertex_index;

constexpr int kRings = 4;  // of triangles around the rim: fairing needs two of vertices

/// The triangles around a rim, ascending.
std::set<std::uint32_t> triangles_around(const Mesh& mesh,
                                         const HalfEdges& edges,
                                         const std::vector<std::uint32_t>& rim) {
  std::set<std::uint32_t> triangles;
  std::set<std::uint32_t> known(rim.begin(), rim.end());
  std::vector<std::uint32_t> front = rim;
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t vertex : front) {
      for (const std::uint32_t edge : edges.leaving(vertex)) {
        triangles.insert(edge / 3);
        for (const std::uint32_t other : mesh.triangles[edge / 3])
          if (known.insert(other).second) next.push_back(other);
      }
    }
    front = std::move(next);
  }
  return triangles;
}

struct Surroundings {
  Surface surface;
  std::map<std::uint32_t, VertexId> id_of;
  std::vector<std::uint32_t> vertex_of;  ///< by CGAL's index

  VertexId add(const Mesh& mesh, std::uint32_t vertex) {
    const auto found = id_of.find(vertex);
    if (found != id_of.end()) return found->second;
    const Eigen::Vector3d p = mesh.vertices_mm[vertex].cast<double>();
    const VertexId id = surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
    id_of.emplace(vertex, id);
    vertex_of.push_back(vertex);
    return id;
  }
};

/// Where a patch may reach: the box around the rim, half its size wider all around.
Eigen::AlignedBox3d reach_of(const Mesh& mesh, const std::vector<std::uint32_t>& rim) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t vertex : rim)
    box.extend(mesh.vertices_mm[vertex].cast<double>());
  const Eigen::Vector3d more = Eigen::Vector3d::Constant(0.5 * box.diagonal().norm());
  return {box.min() - more, box.max() + more};
}

}  // namespace

HolePatch smooth_patch(const Mesh& mesh,
                       const HalfEdges& edges,
                       const std::vector<std::uint32_t>& rim) {
  HolePatch patch;
  if (rim.size() < 3) return patch;
  Surroundings around;
  for (const std::uint32_t triangle : triangles_around(mesh, edges, rim)) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const VertexId ia = around.add(mesh, a);
    const VertexId ib = around.add(mesh, b);
    const VertexId ic = around.add(mesh, c);
    around.surface.add_face(ia, ib, ic);  // one that would not be manifold is left out
  }
  const auto [edge, found] =
      CGAL::halfedge(around.id_of.at(rim[1]), around.id_of.at(rim[0]), around.surface);
  if (!found || !around.surface.is_border(edge)) return patch;
  std::vector<Surface::Face_index> faces;
  std::vector<VertexId> vertices;
  const bool fair =
      std::get<0>(pmp::triangulate_refine_and_fair_hole(around.surface,
                                                        edge,
                                                        std::back_inserter(faces),
                                                        std::back_inserter(vertices),
                                                        pmp::parameters::fairing_continuity(1U)));
  if (!fair) return patch;
  // Slivers around the rim can throw the fairing far off, or to no place at all.
  const Eigen::AlignedBox3d reach = reach_of(mesh, rim);
  std::sort(vertices.begin(), vertices.end());
  auto next = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (const VertexId id : vertices) {
    const auto& p = around.surface.point(id);
    const Eigen::Vector3d place(p.x(), p.y(), p.z());
    if (!reach.contains(place)) return {};  // of NaN, too
    patch.places_mm.emplace_back(place.cast<float>());
    around.vertex_of.resize(std::max<std::size_t>(around.vertex_of.size(), id.idx() + 1U));
    around.vertex_of[id.idx()] = next++;
  }
  std::sort(faces.begin(), faces.end());
  for (const auto face : faces) {
    Mesh::Triangle triangle{};
    std::size_t corner = 0;
    for (const VertexId id : around.surface.vertices_around_face(around.surface.halfedge(face)))
      triangle.at(corner++) = around.vertex_of[id.idx()];
    patch.triangles.push_back(triangle);
  }
  return patch;
}

}  // namespace frangia
#else
namespace frangia {

HolePatch smooth_patch(const Mesh& /*mesh*/,
                       const HalfEdges& /*edges*/,
                       const std::vector<std::uint32_t>& /*rim*/) {
  throw Error(
      ErrorKind::Input,
      "this build has no smooth filling of holes: configure it with FRANGIA_CGAL=ON, or ask "
      "for flat filling");
}

}  // namespace frangia
#endif
