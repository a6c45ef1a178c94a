#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// Number of bins of the measured phase over a fringe.
inline constexpr int kPhaseBins = 96;
/// Number of tiles of the image, along x and along y, within which contrasts are compared.
inline constexpr int kContrastTiles = 8;

/// Phase at the centre of a bin, from -pi to pi.
[[nodiscard]] inline double bin_phase(int bin) {
  return -kPi + kTwoPi * (bin + 0.5) / kPhaseBins;
}

/// Statistics of sampled pixels by their measured phase.
struct FringeBins {
  std::size_t pixels = 0;  ///< that contribute
  /// Inverse variance of `residual`, summed over the pixels of each bin.
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(kPhaseBins);
  /// Weighted mean residual of each frame (column) from the least-squares fringe, over the
  /// modulation.
  Eigen::ArrayXXd residual;
  /// Weighted mean of mean over modulation.
  Eigen::ArrayXd mean_over_modulation = Eigen::ArrayXd::Zero(kPhaseBins);
  /// Number of pixels, and sums of logarithms, by bin (row) and tile (column).
  Eigen::ArrayXXd tile_count;
  Eigen::ArrayXXd tile_log_contrast;
  Eigen::ArrayXXd tile_log_mean;  ///< sum of the logarithm of the mean
};

/// Samples about `samples` pixels of a stack on a regular grid and bins them by the phase that
/// least squares measures.
[[nodiscard]] FringeBins bin_fringes(const FrameStack& stack,
                                     const std::vector<double>& shifts_rad,
                                     const NoiseModel& noise,
                                     std::size_t samples);

}  // namespace frangia
