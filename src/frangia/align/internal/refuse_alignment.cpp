#include "frangia/align/internal/refuse_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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

Mesh scaled_by(Mesh mesh, double factor) {
  for (auto& vertex : mesh.vertices_mm)
    vertex *= static_cast<float>(factor);
  for (float& sigma : mesh.sigma_mm)
    sigma *= static_cast<float>(factor);
  return mesh;
}

/// The best pose of a search, and how much of the mesh it brings near the reference.
AlignmentPose best_pose_of(const Mesh& mesh,
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
  if (candidates.empty()) return {};
  return rate_pose(problem.samples, reference, candidates.front().fit.pose, tolerance_mm, run);
}

/// A length that people and programs take for another one, in mm.
struct LengthUnit {
  const char* name;
  const char* word;  ///< plural
  double mm;
};
constexpr LengthUnit kMillimetre{"mm", "millimetres", 1.0};
constexpr std::array<LengthUnit, 4> kUnits{{{"cm", "centimetres", 10.0},
                                            {"in", "inches", 25.4},
                                            {"ft", "feet", 304.8},
                                            {"m", "metres", 1e3}}};

/// How a mesh lies on a reference whose size is multiplied by a factor.
struct ScaledPose {
  double factor = 1.0;  ///< of the reference
  double tolerance_mm = 0.0;
  AlignmentPose pose;
};

/// The deviation that counts as overlap, of the smaller surface: a part that is a thousand times
/// too small lies near any face by the tolerance of a large reference.
double scaled_tolerance_mm(const Mesh& mesh, double factor, const RayScene& reference) {
  constexpr double kShareOfSize = 0.002;
  return kShareOfSize * std::min(size_of(mesh) / factor, size_of(reference.mesh()));
}

/// The unit by which most of the mesh lies on the reference. `pose_of(scaled, tolerance_mm)` rates
/// a scaled mesh. Units by which the mesh is much smaller or larger than the reference are left
/// out: an accidental overlap proves nothing.
template <typename PoseOf>
ScaledPose best_unit(const Mesh& mesh, const RayScene& reference, const PoseOf& pose_of) {
  constexpr double kLeastSize = 0.15;  // of the reference; a scan of a part of it
  constexpr double kMostSize = 1.8;    // boxes of a turned part differ
  const double ratio = size_of(mesh) / size_of(reference.mesh());
  ScaledPose best;
  for (const LengthUnit& unit : kUnits) {
    for (const double factor : {unit.mm, 1.0 / unit.mm}) {
      if (!(ratio / factor > kLeastSize && ratio / factor < kMostSize)) continue;
      const double tolerance_mm = scaled_tolerance_mm(mesh, factor, reference);
      const AlignmentPose pose = pose_of(scaled_by(mesh, 1.0 / factor), tolerance_mm);
      if (pose.overlap > best.pose.overlap) best = {factor, tolerance_mm, pose};
    }
  }
  return best;
}

/// The unit of a length; none where it is no unit.
std::optional<LengthUnit> unit_of_length(double mm) {
  const auto is_near = [](double a, double b) { return std::abs(a / b - 1.0) < 1e-9; };
  if (is_near(mm, kMillimetre.mm)) return kMillimetre;
  for (const LengthUnit& unit : kUnits)
    if (is_near(mm, unit.mm)) return unit;
  return std::nullopt;
}

/// What to do where a reference that was read by one unit fits when it is `factor` times as large.
std::string unit_advice(double factor, double read_by_mm) {
  const double right_mm = factor * read_by_mm;
  const std::optional<LengthUnit> unit = unit_of_length(right_mm);
  if (read_by_mm != 1.0) {
    return fmt::format("it was read by a unit of {:.6g} mm, and {} fits: state that by `units`",
                       read_by_mm,
                       unit ? unit->name : fmt::format("{:.6g}mm", right_mm));
  }
  if (unit)
    return fmt::format("the reference may be in {}; state `units` {}", unit->word, unit->name);
  const std::optional<LengthUnit> of_mesh = unit_of_length(1.0 / right_mm);
  return fmt::format("{}write the mesh in mm, or state `units` {:.6g}mm",
                     of_mesh ? fmt::format("the mesh may be in {}: ", of_mesh->word) : "",
                     right_mm);
}

/// Refuses a mesh that clearly lies on the reference by another unit only.
void refuse_unit(const ScaledPose& scaled, const AlignmentPose& as_it_is, double read_by_mm) {
  constexpr double kLeastOverlap = 0.5;
  constexpr double kLeastGain = 0.2;
  if (scaled.pose.overlap < std::max(kLeastOverlap, as_it_is.overlap + kLeastGain)) return;
  throw Error(
      ErrorKind::Input,
      fmt::format(
          "the mesh lies on the reference only when the reference is {:.6g} times as large: "
          "{:.0f} % within {:.3g} mm then, RMS {:.3g} mm, and {:.0f} % as it is; {}",
          scaled.factor,
          100.0 * scaled.pose.overlap,
          scaled.factor * scaled.tolerance_mm,
          scaled.factor * scaled.pose.rms_mm,
          100.0 * as_it_is.overlap,
          unit_advice(scaled.factor, read_by_mm)));
}

/// Says why a mesh does not lie on a reference.
[[noreturn]] void throw_refusal(const BestFitOptions& options,
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
                      const Eigen::Isometry3d& found,
                      double overlap,
                      double tolerance_mm,
                      const Run& run) {
  const AlignmentPose own = rate_pose(measured_samples(mesh, kComparedSamples, options.seed),
                                      reference,
                                      found,
                                      scaled_tolerance_mm(mesh, 1.0, reference),
                                      run);
  if (own.overlap < kPlausible) {
    refuse_unit(best_unit(mesh,
                          reference,
                          [&](const Mesh& scaled, double within_mm) {
                            return best_pose_of(scaled, reference, options, within_mm, run);
                          }),
                own,
                options.reference_unit_mm);
  }
  if (overlap >= kPlausible) return;
  const double mirrored =
      best_pose_of(mirrored_in_x(mesh), reference, options, tolerance_mm, run).overlap;
  constexpr double kMirrorGain = 0.08;
  const bool mirror_fits = mirrored > overlap + kMirrorGain && mirrored > 0.5;
  if (mirror_fits || overlap < options.least_overlap)
    throw_refusal(options, overlap, tolerance_mm, mirror_fits);
}

void refuse_unit_of_pose(const Mesh& mesh,
                         const RayScene& reference,
                         const Eigen::Isometry3d& reference_from_mesh,
                         const BestFitOptions& options,
                         const Run& run) {
  const auto pose_of = [&](const Mesh& scaled, double tolerance_mm) {
    return rate_pose(measured_samples(scaled, kComparedSamples, options.seed),
                     reference,
                     reference_from_mesh,
                     tolerance_mm,
                     run);
  };
  const AlignmentPose own = pose_of(mesh, scaled_tolerance_mm(mesh, 1.0, reference));
  if (own.overlap < kPlausible)
    refuse_unit(best_unit(mesh, reference, pose_of), own, options.reference_unit_mm);
}

}  // namespace frangia
