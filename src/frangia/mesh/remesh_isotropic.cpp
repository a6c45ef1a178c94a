// CGAL is expensive to compile: it stays in this source.
#include "frangia/mesh/remesh_isotropic.h"

#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"

#ifdef FRANGIA_WITH_CGAL
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/internal/cgal_mesh.h"
#include "frangia/mesh/internal/interruptible_points.h"
#include "frangia/mesh/internal/transfer_vertex_data.h"
#endif

namespace frangia {
namespace {

/// Limit of the estimated number of triangles. Remeshing takes about 0.6 kB of memory per triangle
/// (`frangia edit sphere.ply --remesh`, 2 million triangles, /usr/bin/time -v).
constexpr std::size_t kRemeshMaxTriangles = 10'000'000;

double surface_area_mm2(const Mesh& mesh) {
  double twice_area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices_mm[a].cast<double>();
    twice_area += (mesh.vertices_mm[b].cast<double>() - origin)
                      .cross(mesh.vertices_mm[c].cast<double>() - origin)
                      .norm();
  }
  return 0.5 * twice_area;
}

}  // namespace

double estimate_remeshed_triangles(const Mesh& mesh, double edge_mm) {
  const double triangle_mm2 = 0.25 * std::sqrt(3.0) * edge_mm * edge_mm;
  return surface_area_mm2(mesh) / triangle_mm2;
}

#ifdef FRANGIA_WITH_CGAL

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using RemeshKernel = CGAL::Simple_cartesian<double>;
using RemeshSurface = CGAL::Surface_mesh<RemeshKernel::Point_3>;

RemeshSurface remesh_surface_of(const Mesh& mesh, const Run& run) {
  std::optional<RemeshSurface> surface = to_cgal<RemeshSurface>(mesh, run);
  require(surface.has_value(),
          "the mesh is not manifold and cannot be remeshed; use `make_manifold` first");
  return *std::move(surface);
}

/// Rounds up to two digits, so that a length in a message is short and still fits.
double rounded_up(double length) {
  const double digit = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return std::ceil(length / digit) * digit;
}

std::string count_text(double count) {
  return count < 1e7 ? fmt::format("{:.0f}", count) : fmt::format("{:.0f} million", count / 1e6);
}

void require_size(const Mesh& mesh, const RemeshOptions& options) {
  const double triangles = estimate_remeshed_triangles(mesh, options.edge_mm);
  const auto most = static_cast<double>(kRemeshMaxTriangles);
  if (triangles <= most) return;
  const double fitting_mm = rounded_up(options.edge_mm * std::sqrt(triangles / most));
  throw Error(ErrorKind::Input,
              fmt::format("edges of {:.3g} mm need about {} triangles, more than {}; use "
                          "edges of {:.3g} mm or longer",
                          options.edge_mm,
                          count_text(triangles),
                          count_text(most),
                          fitting_mm));
}

}  // namespace

Mesh remesh_isotropic(const Mesh& mesh, const RemeshOptions& options, const Run& run) {
  require(options.edge_mm > 0.0 && options.iterations > 0,
          "the edge length and the number of iterations must be positive");
  if (mesh.empty()) return mesh;
  require_size(mesh, options);
  RemeshSurface surface = remesh_surface_of(mesh, run);
  const InterruptiblePoints<RemeshSurface> points(surface, run);
  const auto sharp =
      surface.add_property_map<RemeshSurface::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(
      surface, deg_from_rad(options.crease_rad), sharp, pmp::parameters::vertex_point_map(points));
  for (const auto edge : surface.edges())
    if (surface.is_border(edge)) sharp[edge] = true;
  std::vector<RemeshSurface::Edge_index> sharp_edges;
  for (const auto edge : surface.edges())
    if (sharp[edge]) sharp_edges.push_back(edge);
  pmp::split_long_edges(sharp_edges,
                        options.edge_mm,
                        surface,
                        pmp::parameters::edge_is_constrained_map(sharp).vertex_point_map(points));
  run.report(0.2);
  pmp::isotropic_remeshing(
      surface.faces(),
      options.edge_mm,
      surface,
      pmp::parameters::number_of_iterations(static_cast<unsigned>(options.iterations))
          .edge_is_constrained_map(sharp)
          .protect_constraints(true)
          .vertex_point_map(points));
  run.report(0.9);
  Mesh remeshed = from_cgal(surface, run);
  transfer_vertex_data(remeshed, RayScene(mesh, run), run);
  return remeshed;
}

#else

Mesh remesh_isotropic(const Mesh& /*mesh*/, const RemeshOptions& /*options*/, const Run& /*run*/) {
  throw Error(ErrorKind::Input, "this build cannot remesh: configure it with FRANGIA_CGAL=ON");
}

#endif

}  // namespace frangia
