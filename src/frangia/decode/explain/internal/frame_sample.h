#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// Pixels of the frames of a pattern, in small blocks spread over the image.
struct FrameSample {
  Eigen::ArrayXXd counts;       ///< one row per pixel, one column per frame
  Eigen::ArrayXXd slope_x;      ///< counts per px along x, of the same shape
  Eigen::ArrayXXd slope_y;      ///< the same along y
  Eigen::ArrayXd x;             ///< place of each pixel in the image, -1 to 1
  Eigen::ArrayXd y;             ///< the same along y
  Eigen::ArrayXd scale_counts;  ///< largest count of each pixel, of frames that are not white
  Eigen::ArrayXd variance;      ///< of the camera noise of each pixel, counts squared
  std::vector<int> blocks;      ///< number of each pixel's block, equal ones side by side
  /// Mean and modulation of each pixel by other patterns of the view; NaN where they do not measure
  /// it, empty without such patterns.
  Eigen::ArrayXd reference_mean;
  Eigen::ArrayXd reference_modulation;  ///< the same of the modulation
  /// Wrapped phase of each pixel by one other pattern, rad: `periods` times the phase of this one
  /// is `reference_periods` times that of the other, but for a constant. Empty without a pattern
  /// of an integer ratio.
  Eigen::ArrayXd reference_phase_rad;
  double periods = 1.0;
  double reference_periods = 1.0;

  [[nodiscard]] bool has_reference() const { return reference_mean.size() > 0; }
};

/// Samples pixels that the projector lights: their counts change over the frames by a quarter of
/// what the most changing pixels do. Saturated pixels are left out, unless nearly all pixels of a
/// frame are. `references` are fringe patterns of the view that are as described.
///
/// @shape    900 pixels or more where the image has them in its blocks, 1800 at most; with more
///           than eight frames, of which each pixel says more, as many as have 4500 residuals
[[nodiscard]] FrameSample sample_blocks(const FrameStack& stack,
                                        const NoiseModel& noise,
                                        std::span<const FrameStack* const> references = {});

/// Each n-th block of a sample.
[[nodiscard]] FrameSample every_nth_block(const FrameSample& sample, int n);

}  // namespace frangia
