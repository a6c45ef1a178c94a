#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/align/align_best_fit.h"
#include "frangia/align/internal/fit_pose.h"
#include "frangia/align/internal/free_motions.h"

namespace frangia {

/// Samples of a surface that poses are compared by.
inline constexpr std::size_t kComparedSamples = 12000;

/// Diagonal of the bounding box of the triangles; 0 without triangles.
[[nodiscard]] double size_of(const Mesh& mesh);

/// The tolerance of the options, or that of the size of the reference.
[[nodiscard]] double tolerance_of(const BestFitOptions& options, const RayScene& reference);

/// Overlap and residuals of samples in a pose.
[[nodiscard]] AlignmentPose rate_pose(const std::vector<MeasuredSample>& samples,
                                      const RayScene& reference,
                                      const Eigen::Isometry3d& pose,
                                      double tolerance_mm,
                                      const Run& run);

/// What a search needs of both surfaces.
struct FitProblem {
  const RayScene& reference;
  std::vector<MeasuredSample> samples, reference_samples;
  double size_mm = 0.0;
  double tolerance_mm = 0.0;
};

/// A refined pose and the share of samples near the reference by which it is compared.
struct Candidate {
  PoseFit fit;
  double share = 0.0;
};

/// The free motions of a pose.
[[nodiscard]] std::vector<FreeMotion> free_motions_of(const FitProblem& problem,
                                                      const FindFoot& find_foot,
                                                      const Candidate& candidate,
                                                      const Run& run);

/// The refined poses of a search, or the one near `BestFitOptions::from`, the best first.
/// Poses that free motions of the first one lead to, and that fit no better, are left out.
[[nodiscard]] std::vector<Candidate> candidates_of(const FitProblem& problem,
                                                   const BestFitOptions& options,
                                                   const Run& run);

/// The poses that fit as well as the best and that free motions do not lead to.
[[nodiscard]] std::vector<Candidate> rivals_of(const std::vector<Candidate>& candidates,
                                               const FitProblem& problem,
                                               const std::vector<FreeMotion>& motions);

}  // namespace frangia
