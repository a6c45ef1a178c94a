// CGAL is expensive to compile: it stays in this source.
#include "frangia/mesh/internal/unite_bodies.h"

#ifdef FRANGIA_WITH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/cgal_mesh.h"
#include "frangia/mesh/internal/interruptible_points.h"
#include "frangia/mesh/internal/transfer_vertex_data.h"

namespace frangia {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Stops the corefinement at its progress callbacks.
struct CancelVisitor : pmp::Corefinement::Default_visitor<Surface> {
  const Run* run = nullptr;

  void before_subface_creations(face_descriptor /*face*/, Surface& /*surface*/) { run->check(); }
  void before_face_copy(face_descriptor /*face*/, const Surface& /*from*/, Surface& /*to*/) {
    run->check();
  }
  void progress_filtering_intersections(double /*done*/) const { run->check(); }
  void triangulating_faces_step() const { run->check(); }
  void intersection_of_coplanar_faces_step() const { run->check(); }
  void edge_face_intersections_step() const { run->check(); }
  void start_building_output() const { run->check(); }
};

}  // namespace

std::optional<Mesh> unite_bodies(const Mesh& a, const Mesh& b, const Run& run) {
  std::optional<Surface> of_a = to_cgal<Surface>(a, run);
  std::optional<Surface> of_b = to_cgal<Surface>(b, run);
  if (!of_a || !of_b || !CGAL::is_closed(*of_a) || !CGAL::is_closed(*of_b)) return std::nullopt;
  Surface both;
  CancelVisitor visitor;
  visitor.run = &run;
  try {
    if (!pmp::corefine_and_compute_union(
            *of_a,
            *of_b,
            both,
            pmp::parameters::throw_on_self_intersection(true).visitor(visitor).vertex_point_map(
                InterruptiblePoints<Surface>(*of_a, run)),
            pmp::parameters::vertex_point_map(InterruptiblePoints<Surface>(*of_b, run)),
            pmp::parameters::vertex_point_map(InterruptiblePoints<Surface>(both, run)))) {
      return std::nullopt;
    }
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    return std::nullopt;
  }
  Mesh united = from_cgal(both, run);
  Mesh source = a;
  append_mesh(source, b);
  transfer_vertex_data(united, RayScene(std::move(source), run), run);
  return united;
}

}  // namespace frangia
#else
namespace frangia {

std::optional<Mesh> unite_bodies(const Mesh& /*a*/, const Mesh& /*b*/, const Run& /*run*/) {
  return std::nullopt;
}

}  // namespace frangia
#endif
