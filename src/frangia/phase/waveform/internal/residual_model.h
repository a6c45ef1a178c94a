#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/phase/algorithm/fit_algorithm.h"

namespace frangia {

/// A least-squares fringe through the counts of a pixel.
struct PixelFringe {
  double mean = 0.0;                               ///< counts
  Eigen::Vector2d wave = Eigen::Vector2d::Zero();  ///< cosine and sine part, counts
};

/// The fringe model of one pattern with what its frames add to it.
class ResidualModel {
 public:
  explicit ResidualModel(const FittedAlgorithm& fitted);

  /// Whether harmonics or gains are known.
  [[nodiscard]] bool explains_something() const;
  /// The fringe of a pixel.
  [[nodiscard]] PixelFringe fringe_of(const std::vector<double>& counts) const;
  /// Sum of the squared residuals of a pixel from its least-squares fringe; linear in the frames.
  [[nodiscard]] double squared_residual(const std::vector<double>& counts) const;
  /// The same after removing gains and harmonics from the counts.
  [[nodiscard]] double unexplained_residual(std::vector<double>& counts) const;

 private:
  PhaseAlgorithm fit_;
  FringeWaveform waveform_;
  bool has_harmonics_;
  std::vector<double> shifts_;
  std::vector<double> gains_;
  double steady_share_;                      ///< of the mean counts, which no gain acts on
  std::vector<Eigen::Vector2d> directions_;  ///< of the wave in the frames
};

}  // namespace frangia
