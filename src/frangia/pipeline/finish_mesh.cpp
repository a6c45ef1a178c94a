#include "frangia/pipeline/finish_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
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

Mesh close(Mesh mesh, const Run& run) {
  mesh = make_manifold(std::move(mesh));
  const std::size_t holes = boundary_loops(mesh).size();
  // What is small goes on as curved as the surface around; of what is large nobody knows the shape.
  constexpr double kSmall = 0.15;
  try {
    mesh = fill_holes(mesh, {.up_to_mm = kSmall * diagonal_mm(mesh)}, run);
  } catch (const Error& error) {  // a build without CGAL
    run.note(fmt::format("{}; all holes are closed flat", error.what()));
  }
  mesh = fill_holes(std::move(mesh), {.kind = HoleFill::Flat}, run);
  const auto synthesized =
      std::count(mesh.triangle_marks.begin(), mesh.triangle_marks.end(), Mark::Synthesized);
  run.note(fmt::format(
      "{} holes are closed by {} triangles of {:.4g} mm2 in all, which were not measured and are "
      "marked as synthesized",
      holes,
      synthesized,
      area_mm2(mesh, Mark::Synthesized)));
  if (const std::size_t open = boundary_loops(mesh).size(); open > 0)
    run.warn(fmt::format("{} holes could not be closed: the mesh is not watertight", open));
  return mesh;
}

/// How far the vertices of one mesh lie from another, at most.
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
  if (options.watertight) mesh = close(std::move(mesh), run);
  if (options.tolerance_mm <= 0.0) return mesh;
  const std::size_t before = mesh.triangles.size();
  mesh = decimate(std::move(mesh), {.tolerance_mm = options.tolerance_mm}, run);
  run.note(fmt::format("{} triangles of {} are enough within {:.3g} mm",
                       mesh.triangles.size(),
                       before,
                       options.tolerance_mm));
  return mesh;
}

Mesh limit_triangles(const Mesh& mesh, std::size_t max_triangles, const Run& run) {
  if (max_triangles == 0 || mesh.triangles.size() <= max_triangles) return mesh;
  Mesh fewer = decimate(mesh, {.triangles = max_triangles}, run);
  const double off_mm =
      std::max(max_distance_mm(mesh, RayScene(fewer)), max_distance_mm(fewer, RayScene(mesh)));
  run.note(
      fmt::format("{} triangles of {} are kept, which lie nowhere farther than {:.3g} mm from "
                  "them all",
                  fewer.triangles.size(),
                  mesh.triangles.size(),
                  off_mm));
  return fewer;
}

}  // namespace frangia
