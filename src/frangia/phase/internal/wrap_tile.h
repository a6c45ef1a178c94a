#pragma once

#include <array>
#include <cstddef>

namespace frangia {

/// Number of pixels decoded together, so that their sums stay in the first-level cache.
inline constexpr std::size_t kTilePixels = 1024;
using Lane = std::array<float, kTilePixels>;

/// Weighted sums over the frames of one tile.
struct WrapTile {
  alignas(64) Lane sine;
  alignas(64) Lane cosine;
  alignas(64) Lane mean;
  alignas(64) Lane outer;  ///< Carré's second difference
};

/// Coefficients of the noise of the sums.
struct SumNoise {
  float variance_floor;  ///< of the camera noise, counts squared
  float variance_slope;  ///< of the camera noise, counts squared per count
  float sine_gain;       ///< sum of sine[k]^2
  float cosine_gain;     ///< sum of cosine[k]^2
  float cross_gain;      ///< sum of sine[k] cosine[k]
};

/// Keeps the precision of frames without noise finite, for the deepest frames too.
inline constexpr float kLeastVariance = 1e-12F;

}  // namespace frangia
