#include "frangia/align/internal/refuse_alignment.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/align/internal/pose_candidates.h"

namespace frangia {
namespace {

constexpr double kPlausible = 0.9;  ///< overlap below which other explanations are tried

Mesh mirrored_in_x(Mesh mesh) {
  for (auto& vertex : mesh.vertices_mm)
    vertex.x() = -vertex.x();
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// How much of the mesh the best pose of a search brings near the reference.
double overlap_found(const Mesh& mesh,
                     const RayScene& reference,
                     const BestFitOptions& options,
                     double tolerance_mm,
                     const Run& run) {
  FitProblem problem{reference,
                     measured_samples(mesh, kComparedSamples, options.seed),
                     measured_samples(reference.mesh(), kComparedSamples, options.seed),
                     size_of(reference.mesh()),
                     tolerance_mm};
  const auto candidates = candidates_of(problem, options, run);
  if (candidates.empty()) return 0.0;
  return rate_pose(problem.samples, reference, candidates.front().fit.pose, tolerance_mm, run)
      .overlap;
}

/// The unit of the reference that would give both surfaces the same size; empty when none does.
std::string unit_that_fits(double mesh_size, double reference_size) {
  constexpr std::array<std::pair<const char*, double>, 5> kUnits{
      {{"in", 25.4}, {"m", 1000.0}, {"cm", 10.0}, {"ft", 304.8}, {"um", 0.001}}};
  const double ratio = mesh_size / reference_size;
  for (const auto& [unit, factor] : kUnits)
    if (std::abs(std::log(ratio / factor)) < std::log(1.25)) return unit;
  return {};
}

/// Says why a mesh does not lie on a reference.
[[noreturn]] void throw_refusal(const Mesh& mesh,
                                const RayScene& reference,
                                const BestFitOptions& options,
                                double overlap,
                                double tolerance_mm,
                                bool mirror_fits) {
  if (mirror_fits) {
    throw Error(ErrorKind::Input,
                fmt::format("the reference fits the mirror image of the mesh: {:.0f} % of the mesh "
                            "itself lies on it; mirror one of them, or give the part of the other "
                            "hand as `reference`",
                            100.0 * overlap));
  }
  const std::string unit = unit_that_fits(size_of(mesh), size_of(reference.mesh()));
  if (!unit.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("the mesh is {:.4g} mm large and the reference {:.4g} mm, so its unit "
                            "may be {}; state it by `units`",
                            size_of(mesh),
                            size_of(reference.mesh()),
                            unit));
  }
  throw Error(ErrorKind::Input,
              fmt::format("only {:.0f} % of the mesh lies within {:.3g} mm of the reference in the "
                          "best pose, and {:.0f} % are needed: it is a reference of another part, "
                          "or too little of the part was measured",
                          100.0 * overlap,
                          tolerance_mm,
                          100.0 * options.least_overlap));
}

}  // namespace

void refuse_alignment(const Mesh& mesh,
                      const RayScene& reference,
                      const BestFitOptions& options,
                      double overlap,
                      double tolerance_mm,
                      const Run& run) {
  if (overlap >= kPlausible) return;
  const double mirrored = overlap_found(mirrored_in_x(mesh), reference, options, tolerance_mm, run);
  constexpr double kMirrorGain = 0.08;
  const bool mirror_fits = mirrored > overlap + kMirrorGain && mirrored > 0.5;
  if (mirror_fits || overlap < options.least_overlap)
    throw_refusal(mesh, reference, options, overlap, tolerance_mm, mirror_fits);
}

}  // namespace frangia
