#include "frangia/align/align_best_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/align/internal/fit_pose.h"
#include "frangia/align/internal/free_motions.h"
#include "frangia/align/internal/measured_samples.h"
#include "frangia/align/internal/search_poses.h"
#include "frangia/core/angles.h"
#include "frangia/core/interruptible_chunks.h"
#include "frangia/core/median.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Samples = std::vector<MeasuredSample>;

constexpr std::size_t kCompared = 12000;         ///< samples that poses are compared by
constexpr std::size_t kCandidateSamples = 2500;  ///< that the compared poses are fitted to
constexpr std::size_t kRefined = 12;             ///< poses of the search that are compared
constexpr double kAlike = 0.004;    ///< difference of the shares of two poses that fit alike
constexpr double kPlausible = 0.9;  ///< overlap below which other explanations are tried

double size_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      box.extend(mesh.vertices_mm[v].cast<double>());
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

double tolerance_of(const BestFitOptions& options, const RayScene& reference) {
  constexpr double kTolerance = 0.002;  // of the size
  return options.tolerance_mm > 0.0 ? options.tolerance_mm : kTolerance * size_of(reference.mesh());
}

AlignmentPose rate(const Samples& samples,
                   const RayScene& reference,
                   const Eigen::Isometry3d& pose,
                   double tolerance_mm,
                   const Run& run) {
  std::vector<double> distances(samples.size(), -1.0);
  interruptible_chunks(samples.size(), 512, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double reach = tolerance_mm + 3.0 * samples[i].sigma_mm;
      const auto near = reference.nearest(pose * samples[i].point_mm, reach);
      if (near) distances[i] = near->distance_mm;
    }
  });
  AlignmentPose rated;
  rated.reference_from_mesh = pose;
  std::size_t within = 0;
  double squares = 0.0;
  for (const double distance : distances) {
    if (distance < 0.0) continue;
    ++within;
    squares += distance * distance;
  }
  rated.overlap = static_cast<double>(within) / static_cast<double>(samples.size());
  rated.rms_mm = within > 0 ? std::sqrt(squares / static_cast<double>(within)) : 0.0;
  return rated;
}

/// What a search needs of both surfaces.
struct FitProblem {
  const RayScene& reference;
  Samples samples, reference_samples;
  double size_mm = 0.0;
  double tolerance_mm = 0.0;
};

/// A refined pose and the share of samples near the reference by which it is compared.
struct Candidate {
  PoseFit fit;
  double share = 0.0;
};

std::vector<Candidate> candidates_of(const FitProblem& problem,
                                     const BestFitOptions& options,
                                     const Run& run) {
  std::vector<RatedPose> found = search_poses(problem.samples,
                                              problem.reference_samples,
                                              problem.reference,
                                              options.rotations,
                                              options.seed,
                                              run);
  found.resize(std::min(found.size(), kRefined));
  const FindFoot exact = exact_feet(problem.reference);
  const std::span<const MeasuredSample> some(problem.samples.data(),
                                             std::min(problem.samples.size(), kCompared));
  const auto few = some.first(std::min(some.size(), kCandidateSamples));
  std::vector<Candidate> candidates;
  for (const RatedPose& pose : found) {
    const PoseFitOptions fit{.gate_mm = 0.01 * problem.size_mm,
                             .least_gate_mm = 1e-5 * problem.size_mm,
                             .least_cosine = 0.5,
                             .max_iterations = 25};
    candidates.push_back({fit_pose(few, exact, pose.pose, fit, run)});
  }
  // All are compared by the gate of the best fit, and no finer than the tolerance asks for.
  double gate = problem.tolerance_mm;
  for (const Candidate& candidate : candidates)
    gate = std::min(gate, 2.0 * std::max(candidate.fit.gate_mm, 2e-5 * problem.size_mm));
  gate = std::max(gate, 0.1 * problem.tolerance_mm);
  for (Candidate& candidate : candidates)
    candidate.share = share_within(some, exact, candidate.fit.pose, gate);
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.share > b.share;
  });
  return candidates;
}

/// The poses that fit as well as the best and that free motions do not lead to.
std::vector<Candidate> rivals_of(const std::vector<Candidate>& candidates,
                                 const FitProblem& problem,
                                 const std::vector<FreeMotion>& motions) {
  std::vector<Candidate> alike{candidates.front()};
  const double near = 0.01 * problem.size_mm;
  for (const Candidate& other : candidates) {
    if (other.share < candidates.front().share - kAlike) continue;
    const bool known = std::any_of(alike.begin(), alike.end(), [&](const Candidate& kept) {
      return pose_distance_mm(problem.samples, kept.fit.pose, other.fit.pose) < near ||
             is_reached(problem.samples, motions, kept.fit.pose, other.fit.pose, near);
    });
    if (!known) alike.push_back(other);
  }
  return alike;
}

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
                     measured_samples(mesh, kCompared, options.seed),
                     measured_samples(reference.mesh(), kCompared, options.seed),
                     size_of(reference.mesh()),
                     tolerance_mm};
  const auto candidates = candidates_of(problem, options, run);
  if (candidates.empty()) return 0.0;
  return rate(problem.samples, reference, candidates.front().fit.pose, tolerance_mm, run).overlap;
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
[[noreturn]] void refuse(const Mesh& mesh,
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

/// A list of poses by the rotation from the best one.
std::string list_of(const std::vector<AlignmentPose>& poses) {
  std::string list;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::AngleAxisd turn(poses[i].reference_from_mesh.linear() *
                                 poses.front().reference_from_mesh.linear().transpose());
    const Vector3d axis = turn.axis();
    list += fmt::format("{}{}: overlap {:.2f} %, RMS {:.4f} mm",
                        i == 0 ? "" : "; ",
                        i + 1,
                        100.0 * poses[i].overlap,
                        poses[i].rms_mm);
    if (i > 0) {
      list += fmt::format(", turned by {:.1f} degrees about ({:.3f}, {:.3f}, {:.3f})",
                          deg_from_rad(turn.angle()),
                          axis.x(),
                          axis.y(),
                          axis.z());
    }
  }
  return list;
}

}  // namespace

void BestFitOptions::check() const {
  require(tolerance_mm >= 0.0, "BestFitOptions: tolerance_mm must not be negative");
  require(least_overlap > 0.0 && least_overlap <= 1.0,
          "BestFitOptions: least_overlap must be above 0 and at most 1");
  require(rotations >= 1, "BestFitOptions: rotations must be at least 1");
  require(fine_samples >= 100, "BestFitOptions: fine_samples must be at least 100");
}

AlignmentPose assess_pose(const Mesh& mesh,
                          const RayScene& reference,
                          const Eigen::Isometry3d& reference_from_mesh,
                          const BestFitOptions& options,
                          const Run& run) {
  options.check();
  return rate(measured_samples(mesh, options.fine_samples, options.seed),
              reference,
              reference_from_mesh,
              tolerance_of(options, reference),
              run);
}

Alignment align_best_fit(const Mesh& mesh,
                         const RayScene& reference,
                         const BestFitOptions& options,
                         const Run& run) {
  options.check();
  require(!reference.mesh().empty(), "the reference has no triangles; give a mesh with triangles");
  run.stage("alignment");
  const FitProblem problem{reference,
                           measured_samples(mesh, options.fine_samples, options.seed),
                           measured_samples(reference.mesh(), kCompared, options.seed),
                           size_of(reference.mesh()),
                           tolerance_of(options, reference)};
  const std::vector<Candidate> candidates = candidates_of(problem, options, run);
  const FindFoot exact = exact_feet(reference);
  const auto refined = [&](const Candidate& candidate) {
    const PoseFitOptions fit{
        .gate_mm = std::max(4.0 * candidate.fit.gate_mm, 1e-4 * problem.size_mm),
        .least_gate_mm = 1e-6 * problem.size_mm,
        .least_cosine = 0.5,
        .max_iterations = 40};
    const PoseFit fine = fit_pose(problem.samples, exact, candidate.fit.pose, fit, run);
    AlignmentPose pose = rate(problem.samples, reference, fine.pose, problem.tolerance_mm, run);
    pose.iterations = fine.iterations;
    return pose;
  };
  Alignment alignment;
  if (!candidates.empty()) alignment.pose = refined(candidates.front());
  const double overlap = alignment.pose.overlap;
  if (overlap < kPlausible) {
    const double mirrored =
        overlap_found(mirrored_in_x(mesh), reference, options, problem.tolerance_mm, run);
    constexpr double kMirrorGain = 0.08;
    const bool mirror_fits = mirrored > overlap + kMirrorGain && mirrored > 0.5;
    if (mirror_fits || overlap < options.least_overlap)
      refuse(mesh, reference, options, overlap, problem.tolerance_mm, mirror_fits);
  }
  const std::span<const MeasuredSample> some(problem.samples.data(),
                                             std::min<std::size_t>(problem.samples.size(), 6000));
  const double within = std::clamp(
      2.0 * candidates.front().fit.gate_mm, 0.1 * problem.tolerance_mm, problem.tolerance_mm);
  const std::vector<FreeMotion> motions =
      free_motions(some, exact, candidates.front().fit, within, run);
  for (const FreeMotion& motion : motions)
    alignment.free_directions.push_back(motion.text());
  const std::vector<Candidate> rivals = rivals_of(candidates, problem, motions);
  for (std::size_t i = 0; i < rivals.size(); ++i)
    alignment.alternatives.push_back(i == 0 ? alignment.pose : refined(rivals[i]));
  const std::size_t count = alignment.alternatives.size();
  if (options.start) {
    if (*options.start >= count) {
      throw Error(ErrorKind::Input,
                  fmt::format("`start` {} does not exist: the mesh fits in {} pose{}",
                              *options.start + 1,
                              count,
                              count == 1 ? "" : "s"));
    }
    alignment.pose = alignment.alternatives[*options.start];
  } else if (count > 1) {
    throw Error(
        ErrorKind::Numeric,
        fmt::format("the mesh fits the reference alike in {} poses, choose one by `start`: {}",
                    count,
                    list_of(alignment.alternatives)));
  }
  run.report(1.0);
  return alignment;
}

}  // namespace frangia
