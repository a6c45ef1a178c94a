#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/internal/sum_frames.h"

namespace frangia {

/// Coefficients of the noise of the sums.
struct SumNoise {
  float variance_floor;  ///< of the camera noise, counts squared
  float variance_slope;  ///< of the camera noise, counts squared per count
  float variance_dark;   ///< of the camera noise of dark pixels beyond the floor, counts squared
  float dark_range;      ///< brightness at which a quarter of that is left, counts
  float sine_gain;       ///< sum of sine[k]^2
  float cosine_gain;     ///< sum of cosine[k]^2
  float cross_gain;      ///< sum of sine[k] cosine[k]
};

/// What the kernel computes of a tile, one value per pixel: precisions, of which a sequence needs
/// nothing else, or all that a map keeps.
struct TilePhase {
  float* phase_rad;          ///< in (-pi, pi]; meaningless without modulation
  float* precision;          ///< inverse variance of the phase, in 1 / rad^2; null: sigma is wanted
  float* sigma_rad;          ///< its root's inverse; infinite without modulation
  float* modulation_counts;  ///< with sigma
  float* mean_counts;        ///< with sigma
  std::uint16_t*
      brightest;  ///< maximum over all frames so far; set it to 0 before the first pattern
};

/// Phase of the pixels of one pattern and its noise, tile by tile. Everything that needs the phase
/// of frames uses it, so that the noise of a phase is computed in one place:
/// d phi = (cos phi dS - sin phi dC) / B, where S and C are sums over frames of equal variance.
class PhaseKernel {
 public:
  /// The stack and the algorithm must outlive the kernel.
  ///
  /// @errors   Error(Input) unless the frames match the algorithm in number and each other in size
  ///          and depth
  PhaseKernel(const FrameStack& stack, const PhaseAlgorithm& algorithm, const NoiseModel& noise);

  /// Computes the pixels [at, at + n), n <= kTilePixels. The error of a phase is below 6e-7 rad.
  void wrap(std::size_t at, std::size_t n, WrapTile& scratch, const TilePhase& out) const;

  /// The level at which a pixel is saturated, in counts.
  [[nodiscard]] std::int32_t white() const { return stack_->white_level; }

 private:
  const FrameStack* stack_;
  const PhaseAlgorithm* algorithm_;
  SumNoise noise_;
  bool is_four_step_;
};

}  // namespace frangia
