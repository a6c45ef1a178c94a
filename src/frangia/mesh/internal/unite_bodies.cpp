// CGAL is heavy to compile: it stays in this source.
#include "frangia/mesh/internal/unite_bodies.h"

#ifdef FRANGIA_WITH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/cgal_mesh.h"
#include "frangia/mesh/internal/transfer_vertex_data.h"

namespace frangia {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

std::optional<Mesh> unite_bodies(const Mesh& a, const Mesh& b) {
  std::optional<Surface> of_a = to_cgal<Surface>(a);
  std::optional<Surface> of_b = to_cgal<Surface>(b);
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
  Mesh united = from_cgal(both);
  Mesh source = a;
  append_mesh(source, b);
  transfer_vertex_data(united, RayScene(std::move(source)));
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
