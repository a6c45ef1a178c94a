#pragma once

#include <array>
#include <cstddef>

namespace frangia {

/// Number of pixels decoded together, so that their sums stay in the first-level cache.
inline constexpr std::size_t kTilePixels = 1024;
using Lane = std::array<float, kTilePixels>;

}  // namespace frangia
