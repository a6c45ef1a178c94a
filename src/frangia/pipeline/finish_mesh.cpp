#include "frangia/pipeline/finish_mesh.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/parallel.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"

namespace frangia {
namespace {

double area_mm2(const Mesh& mesh, Mark mark) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangle_marks.size(); ++i) {
    if (mesh.triangle_marks[i] != mark) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d origin = mesh.vertices_mm[a].cast<double>();
    sum += 0.5 * (mesh.vertices_mm[b].cast<double>() - origin)
                     .cross(mesh.vertices_mm[c].cast<double>() - origin)
                     .norm();
  }
  return sum;
}

double diagonal_mm(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const auto& vertex : mesh.vertices_mm)
    box.extend(vertex);
  return static_cast<double>(box.diagonal().norm());
}

std::string holes_text(std::size_t count) {
  return fmt::format("{} hole{}", count, count == 1 ? "" : "s");
}

Mesh make_watertight(Mesh mesh, const Run& run) {
  mesh = make_manifold(std::move(mesh), run);
  const std::size_t holes = boundary_loops(mesh).size();
  // Small holes continue the surrounding curvature. The shape of larger ones is unknown: flat.
  constexpr double kSmall = 0.15;  // of the diagonal of the mesh
  const double small_mm = kSmall * diagonal_mm(mesh);
  mesh = fill_holes(std::move(mesh), {.up_to_mm = small_mm}, run);
  mesh = fill_holes(std::move(mesh), {.kind = HoleFill::Flat}, run);
  const auto synthesized =
      std::count(mesh.triangle_marks.begin(), mesh.triangle_marks.end(), Mark::Synthesized);
  run.note(fmt::format(
      "{} filled with {} triangles of {:.4g} mm2 in total; they are not measured and are marked as "
      "synthesized",
      holes_text(holes),
      synthesized,
      area_mm2(mesh, Mark::Synthesized)));
  if (const std::size_t open = boundary_loops(mesh).size(); open > 0)
    run.warn(fmt::format("the mesh is not watertight: {} could not be filled", holes_text(open)));
  return mesh;
}

/// The largest distance of the vertices of one mesh from another.
double max_distance_mm(const Mesh& from, const RayScene& to) {
  std::vector<double> distances(from.vertices_mm.size());
  parallel_chunks(distances.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto nearest = to.nearest(from.vertices_mm[i].cast<double>());
      distances[i] = nearest ? nearest->distance_mm : 0.0;
    }
  });
  return distances.empty() ? 0.0 : *std::max_element(distances.begin(), distances.end());
}

}  // namespace

Mesh finish_mesh(Mesh mesh, const FinishOptions& options, const Run& run) {
  if (options.watertight) mesh = make_watertight(std::move(mesh), run);
  if (options.tolerance_mm <= 0.0) return mesh;
  const std::size_t before = mesh.triangles.size();
  mesh = decimate(std::move(mesh), {.tolerance_mm = options.tolerance_mm}, run);
  run.note(fmt::format("decimated to {} of {} triangles within {:.3g} mm",
                       mesh.triangles.size(),
                       before,
                       options.tolerance_mm));
  return mesh;
}

Mesh limit_triangles(const Mesh& mesh, std::size_t max_triangles, const Run& run) {
  if (max_triangles == 0 || mesh.triangles.size() <= max_triangles) return mesh;
  Mesh fewer = decimate(mesh, {.triangles = max_triangles}, run);
  const double distance_mm = std::max(max_distance_mm(mesh, RayScene(fewer, run)),
                                      max_distance_mm(fewer, RayScene(mesh, run)));
  run.note(
      fmt::format("decimated to {} of {} triangles, at most {:.3g} mm from the original surface",
                  fewer.triangles.size(),
                  mesh.triangles.size(),
                  distance_mm));
  return fewer;
}

}  // namespace frangia
