#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {

/// Number of pixels decoded together, so that their sums stay in the first-level cache.
inline constexpr std::size_t kTilePixels = 1024;
using Lane = std::array<float, kTilePixels>;

/// Weighted sums over the frames of one tile.
struct WrapTile {
  alignas(64) Lane sine;
  alignas(64) Lane cosine;
  alignas(64) Lane mean;
  alignas(64) Lane outer;                                        ///< Carré's second difference
  alignas(64) std::array<std::uint16_t, kTilePixels> brightest;  ///< maximum over all frames so far
  alignas(64) std::array<std::int32_t,
                         kTilePixels> status;  ///< a PixelStatus; narrower types do not vectorize
};

/// @errors   Error(Input) unless the frames match the algorithm in number and each other in size
///          and depth
void check_frames(const FrameStack& stack, const PhaseAlgorithm& algorithm);

/// Coefficients of the phase noise.
struct TileNoise {
  std::int32_t white;    ///< the level at which a pixel is saturated
  float variance_floor;  ///< of the camera noise, counts squared
  float variance_slope;  ///< of the camera noise, counts squared per count
  float sine_gain;       ///< sum of sine[k]^2
  float cosine_gain;     ///< sum of cosine[k]^2
  float cross_gain;      ///< sum of sine[k] cosine[k]
};
[[nodiscard]] TileNoise tile_noise(const FrameStack& stack,
                                   const PhaseAlgorithm& algorithm,
                                   const NoiseModel& noise);

/// Computes the phase from the sums, in (-pi, pi]; error below 5e-7 rad.
void find_tile_phase(const WrapTile& tile, std::size_t n, float* phase_rad);

}  // namespace frangia
