#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace frangia {

/// Number of pixels decoded together, so that their sums stay in the first-level cache.
inline constexpr std::size_t kTilePixels = 1024;
using Lane = std::array<float, kTilePixels>;

/// Wrapped phases of up to kTilePixels pixels and their inverse variances, one pointer per map.
struct TilePhases {
  std::span<const float* const> phase_rad;
  std::span<const float* const> precision;
  const std::int32_t* invalid = nullptr;  ///< nonzero where a phase is missing
};

}  // namespace frangia
