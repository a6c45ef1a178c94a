#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/decode/explain/frame_hypothesis.h"
#include "frangia/decode/explain/internal/frame_sample.h"

namespace frangia {

/// How well a hypothesis predicts sampled frames, before the number of effective samples is known.
struct FrameScore {
  double log_density = 0.0;  ///< sum over the pixels that are counted
  /// Of the frames that show fringes, of every pixel by what the counted ones say.
  Eigen::ArrayXd pixel_densities;
  Eigen::ArrayXd value_densities;  ///< the part of them that mean, modulation and phase are
  /// What other patterns add to them, as `ReferenceGain`; empty without them.
  Eigen::ArrayXd reference_gains;
  Eigen::ArrayXd squared_rests;       ///< squared residual of each pixel, counts squared
  double unexplained = 0.0;           ///< RMS of the residual beyond the noise, over the modulation
  double excess = 0.0;                ///< share of the variance of the residuals that is not noise
  double largest_gain = 0.0;          ///< of the gains of single frames that are nuisances
  Eigen::MatrixX2d displacements_px;  ///< of the displaced frames, if these are displaced
  double largest_displacement_px = 0.0;  ///< of whole frames
  Eigen::VectorXd step_errors_rad;       ///< of the shown frames, if their steps are free
  double lamp_share = 0.0;               ///< light of another lamp over that of the brightest frame
  /// Normal matrix of the nuisances, each in units of its prior; the price of what they may
  /// explain follows from it.
  Eigen::MatrixXd nuisances;
  double nuisance_price = 0.0;    ///< half the squared nuisances in units of their priors
  std::vector<double> residuals;  ///< in units of their sigma, one per pixel; empty without any

  /// The log evidence of `share` of the samples.
  [[nodiscard]] double log_evidence(double share) const;
};

/// Scores a hypothesis. Gains of single frames (3 %), and harmonics 2 to 12 that are coherent with
/// the phase, are nuisances that it fits together, with their priors; depth edges and highlights
/// are outliers of a broad density. Where other patterns tell the mean and the modulation of the
/// pixels, the hypothesis has to agree with them.
///
/// @shape    `counted`: 1 for the pixels that are fitted and scored, 0 for others; empty for all
[[nodiscard]] FrameScore score_frames(const FrameSample& sample,
                                      const FrameHypothesis& hypothesis,
                                      const Eigen::ArrayXd& counted = {});

/// A quick estimate of the mean log density of a pixel, without nuisances: it chooses which
/// hypotheses are scored.
///
/// @shape    `moments`: mean of the products of the frames' counts over scale^2, N x N;
///           `means`: of the counts over scale
[[nodiscard]] double rough_score(const Eigen::MatrixXd& moments,
                                 const Eigen::VectorXd& means,
                                 double relative_noise,
                                 const FrameHypothesis& hypothesis);

}  // namespace frangia
