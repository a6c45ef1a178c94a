// CGAL is heavy to compile: it stays in this source.
#include "frangia/mesh/remesh_isotropic.h"

#include "frangia/core/error.h"

#ifdef FRANGIA_WITH_CGAL
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/internal/cgal_mesh.h"
#include "frangia/mesh/internal/transfer_vertex_data.h"

namespace frangia {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Plain = CGAL::Simple_cartesian<double>;
using PlainSurface = CGAL::Surface_mesh<Plain::Point_3>;

PlainSurface plain_surface_of(const Mesh& mesh) {
  std::optional<PlainSurface> surface = to_cgal<PlainSurface>(mesh);
  require(surface.has_value(),
          "remesh: the mesh is not manifold; make it so first (--make-manifold)");
  return *std::move(surface);
}

}  // namespace

Mesh remesh_isotropic(const Mesh& mesh, const RemeshOptions& options, const Run& run) {
  require(options.edge_mm > 0.0 && options.iterations > 0,
          "remesh: the length of the edges and the iterations must be positive");
  if (mesh.empty()) return mesh;
  PlainSurface surface = plain_surface_of(mesh);
  const auto sharp =
      surface.add_property_map<PlainSurface::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(surface, deg_from_rad(options.crease_rad), sharp);
  for (const auto edge : surface.edges())
    if (surface.is_border(edge)) sharp[edge] = true;
  std::vector<PlainSurface::Edge_index> sharp_edges;
  for (const auto edge : surface.edges())
    if (sharp[edge]) sharp_edges.push_back(edge);
  pmp::split_long_edges(
      sharp_edges, options.edge_mm, surface, pmp::parameters::edge_is_constrained_map(sharp));
  run.report(0.2);
  pmp::isotropic_remeshing(
      surface.faces(),
      options.edge_mm,
      surface,
      pmp::parameters::number_of_iterations(static_cast<unsigned>(options.iterations))
          .edge_is_constrained_map(sharp)
          .protect_constraints(true));
  run.report(0.9);
  Mesh even = from_cgal(surface);
  transfer_vertex_data(even, RayScene(mesh));
  return even;
}

}  // namespace frangia
#else
namespace frangia {

Mesh remesh_isotropic(const Mesh& /*mesh*/, const RemeshOptions& /*options*/, const Run& /*run*/) {
  throw Error(ErrorKind::Input,
              "this build has no uniform remeshing: configure it with FRANGIA_CGAL=ON");
}

}  // namespace frangia
#endif
