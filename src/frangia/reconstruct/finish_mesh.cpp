#include "frangia/reconstruct/finish_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
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

/// Median sigma of the vertices of each component; 0 where none is known.
std::vector<double> median_sigmas(const Mesh& mesh, const ConnectedComponents& parts) {
  std::vector<double> medians(parts.components.size());
  if (mesh.sigma_mm.empty()) return medians;
  std::vector<std::vector<float>> known(medians.size());
  std::vector<std::uint8_t> seen(mesh.vertices_mm.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      if (seen[vertex]++ != 0 || !std::isfinite(mesh.sigma_mm[vertex])) continue;
      known[parts.component_of[t]].push_back(mesh.sigma_mm[vertex]);
    }
  }
  for (std::size_t i = 0; i < medians.size(); ++i)
    if (!known[i].empty()) medians[i] = static_cast<double>(median(std::move(known[i])));
  return medians;
}

RemovedIslands remove_noise(Mesh& mesh, const Run& run) {
  constexpr double kFewEdges = 6.0;  // a triangle or a few dozen, between views that do not overlap
  constexpr double kFewSigmas = 2.0;
  RemovedIslands found;
  if (mesh.empty()) return found;
  const ConnectedComponents parts = connected_components(mesh);
  const std::size_t count = parts.components.size();
  if (count < 2) return found;
  const double edges_mm = kFewEdges * mean_edge_length_mm(mesh);
  const std::vector<double> sigmas_mm = median_sigmas(mesh, parts);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (parts.components[i].area_mm2 > parts.components[largest].area_mm2) largest = i;
  std::vector<std::uint8_t> removed(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double own_mm = parts.components[i].size_mm;
    if (i == largest || own_mm > std::max(edges_mm, kFewSigmas * sigmas_mm[i])) continue;
    removed[i] = 1;
    ++found.count;
    found.largest_mm = std::max(found.largest_mm, own_mm);
  }
  if (found.count == 0) return found;
  Selection kept(mesh.triangles.size());
  for (std::size_t t = 0; t < kept.size(); ++t)
    kept[t] = removed[parts.component_of[t]] == 0 ? 1 : 0;
  const std::size_t before = mesh.triangles.size();
  keep_triangles(mesh, kept);
  found.triangles = before - mesh.triangles.size();
  run.note(
      fmt::format("{} of {} components removed: islands of at most {:.3g} mm, {} triangles in "
                  "total, which are too small to be told from noise; `keep_islands` keeps them",
                  found.count,
                  count,
                  found.largest_mm,
                  found.triangles));
  return found;
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

FinishedMesh finish_mesh(Mesh mesh, const FinishOptions& options, const Run& run) {
  FinishedMesh out;
  if (!options.keep_islands) out.removed = remove_noise(mesh, run);
  if (options.watertight) mesh = make_watertight(std::move(mesh), run);
  const std::size_t before = mesh.triangles.size();
  if (options.tolerance_mm > 0.0) {
    mesh = decimate(std::move(mesh), {.tolerance_mm = options.tolerance_mm}, run);
    run.note(fmt::format("decimated to {} of {} triangles within {:.3g} mm",
                         mesh.triangles.size(),
                         before,
                         options.tolerance_mm));
  }
  if (options.max_triangles > 0) mesh = limit_triangles(mesh, options.max_triangles, run);
  out.mesh = std::move(mesh);
  return out;
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
