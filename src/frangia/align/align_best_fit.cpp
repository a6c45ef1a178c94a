#include "frangia/align/align_best_fit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/align/internal/fit_pose.h"
#include "frangia/align/internal/pose_candidates.h"
#include "frangia/align/internal/refuse_alignment.h"
#include "frangia/core/angles.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

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

/// The last fit, to some of the samples until it converges, and to all of them from there. A pose
/// with a free direction wanders along it, and only the most iterations end that.
PoseFit refined_fit(const FitProblem& problem,
                    const FindFoot& exact,
                    const PoseFit& near,
                    bool to_all,
                    const Run& run) {
  constexpr std::size_t kSome = 4000;
  constexpr int kLastIterations = 10;
  PoseFitOptions fit{.gate_mm = std::max(4.0 * near.gate_mm, 1e-4 * problem.size_mm),
                     .least_gate_mm = 1e-6 * problem.size_mm,
                     .least_cosine = 0.5,
                     .max_iterations = 40};
  const std::span<const MeasuredSample> some(problem.samples.data(),
                                             std::min(problem.samples.size(), kSome));
  const PoseFit first = fit_pose(some, exact, near.pose, fit, run);
  if (!to_all || some.size() == problem.samples.size()) return first;
  fit.gate_mm = std::max(2.0 * first.gate_mm, 1e-4 * problem.size_mm);
  fit.max_iterations = kLastIterations;
  PoseFit last = fit_pose(problem.samples, exact, first.pose, fit, run);
  last.iterations += first.iterations;
  return last;
}

}  // namespace

void BestFitOptions::check() const {
  require(tolerance_mm >= 0.0, "BestFitOptions: tolerance_mm must not be negative");
  require(least_overlap > 0.0 && least_overlap <= 1.0,
          "BestFitOptions: least_overlap must be above 0 and at most 1");
  require(reference_unit_mm > 0.0, "BestFitOptions: reference_unit_mm must be above 0");
  require(rotations >= 1, "BestFitOptions: rotations must be at least 1");
  require(fine_samples >= 100, "BestFitOptions: fine_samples must be at least 100");
}

AlignmentPose assess_pose(const Mesh& mesh,
                          const RayScene& reference,
                          const Eigen::Isometry3d& reference_from_mesh,
                          const BestFitOptions& options,
                          const Run& run) {
  options.check();
  return rate_pose(measured_samples(mesh, options.fine_samples, options.seed),
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
                           measured_samples(reference.mesh(), kComparedSamples, options.seed),
                           size_of(reference.mesh()),
                           tolerance_of(options, reference)};
  const std::vector<Candidate> candidates = candidates_of(problem, options, run);
  const FindFoot exact = exact_feet(reference);
  // Of several poses that fit alike, all samples are fitted in the chosen one alone.
  const auto refined = [&](const Candidate& candidate, bool to_all) {
    const PoseFit fine = refined_fit(problem, exact, candidate.fit, to_all, run);
    AlignmentPose pose =
        rate_pose(problem.samples, reference, fine.pose, problem.tolerance_mm, run);
    pose.iterations = fine.iterations;
    pose.uncertainty = pose_covariance(problem.samples, exact, fine);
    return pose;
  };
  Alignment alignment;
  if (!candidates.empty()) alignment.pose = refined(candidates.front(), true);
  // A part that is out of a narrow tolerance is no other part.
  const double wide = std::max(problem.tolerance_mm, tolerance_of({}, reference));
  const double overlap = alignment.pose.overlap;
  const double plausible =
      wide > problem.tolerance_mm && !candidates.empty()
          ? rate_pose(problem.samples, reference, alignment.pose.reference_from_mesh, wide, run)
                .overlap
          : overlap;
  if (!options.from) {
    refuse_alignment(
        mesh, reference, options, alignment.pose.reference_from_mesh, plausible, wide, run);
  } else if (plausible < options.least_overlap) {
    throw Error(
        ErrorKind::Input,
        fmt::format("only {:.0f} % of the mesh lies within {:.3g} mm of the reference in the pose "
                    "near the given points, and {:.0f} % are needed; choose other points, or leave "
                    "them out to try every pose",
                    100.0 * plausible,
                    wide,
                    100.0 * options.least_overlap));
  }
  const std::vector<FreeMotion> motions = free_motions_of(problem, exact, candidates.front(), run);
  for (const FreeMotion& motion : motions)
    alignment.free_directions.push_back(motion.text());
  const std::vector<Candidate> rivals = rivals_of(candidates, problem, motions);
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    alignment.alternatives.push_back(i == 0 ? alignment.pose
                                            : refined(rivals[i], options.start == i));
  }
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
