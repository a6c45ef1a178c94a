#include "frangia/align/internal/pose_candidates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "frangia/align/internal/search_poses.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::size_t kCandidateSamples = 2500;  ///< that the compared poses are fitted to
constexpr std::size_t kRefined = 12;             ///< poses of the search that are compared
constexpr double kNearPose = 0.01;               ///< of the size: poses that are one
constexpr double kAlike = 0.004;  ///< difference of the shares of two poses that fit alike

/// The pose that a stated one leads to. Clicks on a part miss their places by a few percent of it.
RatedPose near_pose(const FitProblem& problem,
                    const FindFoot& exact,
                    const Eigen::Isometry3d& from,
                    const Run& run) {
  constexpr double kReach = 0.1;  // of the size
  const std::span<const MeasuredSample> few(problem.samples.data(),
                                            std::min(problem.samples.size(), kCandidateSamples));
  const PoseFitOptions fit{.gate_mm = kReach * problem.size_mm,
                           .least_gate_mm = 1e-3 * problem.size_mm,
                           .least_cosine = 0.5,
                           .max_iterations = 40};
  return {fit_pose(few, exact, from, fit, run).pose, 0.0};
}

/// How far a sample may lie from the reference and still fit, while its pose is moved.
double free_motion_reach_mm(const FitProblem& problem, const Candidate& candidate) {
  return std::clamp(2.0 * candidate.fit.gate_mm, 0.1 * problem.tolerance_mm, problem.tolerance_mm);
}

/// The poses that free motions of a candidate lead to and that fit no better: round parts have as
/// many of them as the search keeps. A key or a flat shows with few samples after a short fit.
class PoseFamily {
 public:
  PoseFamily(const FitProblem& problem,
             const FindFoot& exact,
             const Candidate& first,
             const Run& run)
      : problem_(problem),
        exact_(exact),
        first_(first.fit.pose),
        within_mm_(free_motion_reach_mm(problem, first)),
        motions_(free_motions_of(problem, exact, first, run)),
        share_(share_within(samples(kScored), exact, first_, within_mm_)) {}

  [[nodiscard]] bool holds(const Eigen::Isometry3d& pose,
                           PoseFitOptions fit,
                           const Run& run) const {
    const double near = kNearPose * problem_.size_mm;
    if (!is_reached(problem_.samples, motions_, first_, pose, near)) return false;
    fit.max_iterations = kQuickIterations;
    const PoseFit quick = fit_pose(samples(kQuick), exact_, pose, fit, run);
    return share_within(samples(kScored), exact_, quick.pose, within_mm_) <= share_ + kBetter;
  }

 private:
  static constexpr std::size_t kQuick = 600;
  static constexpr std::size_t kScored = 3000;
  static constexpr int kQuickIterations = 12;
  static constexpr double kBetter = 0.001;  // share: a few of the samples

  [[nodiscard]] std::span<const MeasuredSample> samples(std::size_t count) const {
    return {problem_.samples.data(), std::min(problem_.samples.size(), count)};
  }

  const FitProblem& problem_;
  const FindFoot& exact_;
  Eigen::Isometry3d first_;
  double within_mm_;
  std::vector<FreeMotion> motions_;
  double share_;
};

}  // namespace

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

AlignmentPose rate_pose(const std::vector<MeasuredSample>& samples,
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

std::vector<FreeMotion> free_motions_of(const FitProblem& problem,
                                        const FindFoot& find_foot,
                                        const Candidate& candidate,
                                        const Run& run) {
  constexpr std::size_t kSome = 2000;
  const std::span<const MeasuredSample> some(problem.samples.data(),
                                             std::min(problem.samples.size(), kSome));
  const double within =
      std::clamp(2.0 * candidate.fit.gate_mm, 0.1 * problem.tolerance_mm, problem.tolerance_mm);
  return free_motions(some, find_foot, candidate.fit, within, run);
}

std::vector<Candidate> candidates_of(const FitProblem& problem,
                                     const BestFitOptions& options,
                                     const Run& run) {
  const FindFoot exact = exact_feet(problem.reference);
  std::vector<RatedPose> found =
      options.from ? std::vector<RatedPose>{near_pose(problem, exact, *options.from, run)}
                   : search_poses(problem.samples,
                                  problem.reference_samples,
                                  problem.reference,
                                  options.rotations,
                                  options.seed,
                                  run);
  found.resize(std::min(found.size(), kRefined));
  const std::span<const MeasuredSample> some(problem.samples.data(),
                                             std::min(problem.samples.size(), kComparedSamples));
  const auto few = some.first(std::min(some.size(), kCandidateSamples));
  const PoseFitOptions fit{.gate_mm = 0.01 * problem.size_mm,
                           .least_gate_mm = 1e-5 * problem.size_mm,
                           .least_cosine = 0.5,
                           .max_iterations = 25};
  std::vector<Candidate> candidates;
  std::optional<PoseFamily> family;  // of the first candidate
  for (const RatedPose& pose : found) {
    if (family && family->holds(pose.pose, fit, run)) continue;
    candidates.push_back({fit_pose(few, exact, pose.pose, fit, run)});
    if (!family && found.size() > 1) family.emplace(problem, exact, candidates.front(), run);
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

std::vector<Candidate> rivals_of(const std::vector<Candidate>& candidates,
                                 const FitProblem& problem,
                                 const std::vector<FreeMotion>& motions) {
  std::vector<Candidate> alike{candidates.front()};
  const double near = kNearPose * problem.size_mm;
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

}  // namespace frangia
