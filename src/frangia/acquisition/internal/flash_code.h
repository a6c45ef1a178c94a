#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace frangia {

/// Flashes, bright or dark, that are repeated without end. No shift of the sequence by less than
/// its length is like it or its inverse, so that flashes that are seen late tell by how many.
///
/// @source   maximum length sequence of x^4 + x + 1
inline constexpr std::array<bool, 15> kFlashCode{false,
                                                 false,
                                                 false,
                                                 true,
                                                 false,
                                                 false,
                                                 true,
                                                 true,
                                                 false,
                                                 true,
                                                 false,
                                                 true,
                                                 true,
                                                 true,
                                                 true};

/// How late flashes are seen.
struct FlashLag {
  std::size_t frames = 0;  ///< whole frames
  double share = 0.0;      ///< of the exposures that still saw the flash before, -0.1 to 0.9
  double residual = 0.0;   ///< rms of what this does not explain, as a share of a flash's light
};

/// Fits the lag to the light of successive frames, each captured when the next flash of the code
/// was shown: light_k = (1 - share) code_{k - frames} + share code_{k - frames - 1}.
///
/// @shape    light: 0 for dark, 1 for bright; the first one is of flash 0, the code is cyclic
[[nodiscard]] FlashLag flash_lag(std::span<const double> light);

}  // namespace frangia
