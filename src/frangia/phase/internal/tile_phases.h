#pragma once

#include <cstdint>
#include <span>

namespace frangia {

/// Wrapped phases of up to kTilePixels pixels and their inverse variances, one pointer per map.
struct TilePhases {
  std::span<const float* const> phase_rad;
  std::span<const float* const> precision;
  const std::int32_t* invalid = nullptr;  ///< nonzero where a phase is missing
};

}  // namespace frangia
