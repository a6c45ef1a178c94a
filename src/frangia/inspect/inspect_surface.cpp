#include "frangia/inspect/inspect_surface.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

Eigen::AlignedBox3f box_of_vertices(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    box.extend(vertex);
  return box;
}

/// Refuses a mesh that lies beside the reference: a face of one that looks at the other from afar
/// is no deviation.
void refuse_apart(const Mesh& mesh, const Mesh& reference) {
  constexpr float kApart = 0.01F;  // of the size of the reference: a part may be out by less
  const Eigen::AlignedBox3f own = box_of_vertices(mesh);
  const Eigen::AlignedBox3f nominal = box_of_vertices(reference);
  if (own.isEmpty() || nominal.isEmpty()) return;
  const float apart_mm = own.exteriorDistance(nominal);
  if (!(apart_mm > kApart * nominal.diagonal().norm())) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("the mesh lies {:.3g} mm beside the reference, so that nothing of it can be "
                  "compared: set `align` to best-fit, or give files of one frame",
                  apart_mm));
}

/// Refuses a mesh of which nothing lies on the reference, such as a small one inside of it: there
/// is no overlap of which a verdict could be.
void refuse_without_overlap(const Deviations& deviations, const Mesh& reference) {
  constexpr float kFar = 0.05F;  // of the size of the reference: castings have an allowance of less
  float nearest_mm = std::numeric_limits<float>::infinity();
  for (const float deviation_mm : deviations.deviation_mm)
    nearest_mm = std::fmin(nearest_mm, std::abs(deviation_mm));  // not NaN
  const float size_mm = box_of_vertices(reference).diagonal().norm();
  if (!std::isfinite(nearest_mm) || !(nearest_mm > kFar * size_mm)) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("no point of the mesh lies within {:.3g} mm of the reference, so that nothing of "
                  "it can be compared: set `align` to best-fit, check the `units` of the "
                  "reference, or give files of one frame",
                  nearest_mm));
}

}  // namespace

SurfaceInspection inspect_surface(const Mesh& mesh,
                                  const RayScene& reference,
                                  const SurfaceRule& rule,
                                  const DeviationOptions& options,
                                  const Run& run) {
  rule.check();
  refuse_apart(mesh, reference.mesh());
  SurfaceInspection found;
  found.deviations = deviations_of(mesh, reference, options, run);
  refuse_without_overlap(found.deviations, reference.mesh());
  found.summary = summarize(mesh, found.deviations);
  found.verdict = judge_surface(mesh, found.deviations, reference, rule, run);
  return found;
}

}  // namespace frangia
