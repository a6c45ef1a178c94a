#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/phase_algorithm.h"

namespace frangia {

/// Pixels that are decoded together, so that all that is summed of them stays in the first-level
/// cache.
inline constexpr std::size_t kTilePixels = 1024;
using Lane = std::array<float, kTilePixels>;

/// Sums over the frames of one tile.
struct WrapTile {
  alignas(64) Lane sine;
  alignas(64) Lane cosine;
  alignas(64) Lane mean;
  alignas(64) Lane outer;                                        ///< Carré's second difference
  alignas(64) std::array<std::uint16_t, kTilePixels> brightest;  ///< brightest of all frames so far
  alignas(64) std::array<std::int32_t, kTilePixels> status;  ///< a PixelStatus; narrow ones do not
                                                             ///< vectorise
};

/// errors   Error(Input) unless the frames are as many as the algorithm takes, of one size and
/// depth
void check_frames(const FrameStack& stack, const PhaseAlgorithm& algorithm);

/// What the noise of a phase follows from.
struct TileNoise {
  std::int32_t white;    ///< the level at which a pixel is saturated
  float variance_floor;  ///< of the camera's noise, counts squared
  float variance_slope;  ///< counts squared a count
  float sine_gain;       ///< sum of sine[k]^2
  float cosine_gain;     ///< sum of cosine[k]^2
  float cross_gain;      ///< sum of sine[k] cosine[k]
};
[[nodiscard]] TileNoise tile_noise(const FrameStack& stack,
                                   const PhaseAlgorithm& algorithm,
                                   const NoiseModel& noise);

/// Sums over all frames of the pixels [at, at + n), n at most kTilePixels. `brightest` goes on from
/// what it was: fill it with 0 before the first stack.
void sum_frames(const FrameStack& stack,
                const PhaseAlgorithm& algorithm,
                std::size_t at,
                std::size_t n,
                WrapTile& tile);

/// The phase of each pixel whose sums are known, in (-pi, pi]; error below 5e-7 rad.
void find_tile_phase(const WrapTile& tile, std::size_t n, float* phase_rad);

}  // namespace frangia
