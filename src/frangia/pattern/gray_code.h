#pragma once

#include <cstdint>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// The reflected binary code: neighbouring numbers differ in one bit, so that a pixel on the edge
/// between two stripes reads one of the two, never a third.
///
/// source   Gray 1953, US patent 2 632 058
[[nodiscard]] constexpr std::uint32_t binary_to_gray(std::uint32_t number) {
  return number ^ (number >> 1U);
}
[[nodiscard]] constexpr std::uint32_t gray_to_binary(std::uint32_t gray) {
  for (std::uint32_t shift = 1; shift < 32; shift *= 2)
    gray ^= gray >> shift;
  return gray;
}

/// Whether a frame of a Gray code pattern lights the stripe at this column (or row) of the
/// projector; columns have their number in their centre.
[[nodiscard]] bool is_stripe_bright(const Pattern& gray, int frame, double column);

/// Gray code whose stripes are half a fringe wide, over `columns` of the projector: a stripe read
/// as its neighbour still tells the fringe.
///
/// errors   Error(Input) when the stripes are not finite and at least a pixel wide
[[nodiscard]] Pattern gray_code_for_fringes(const Pattern& fringes, double columns, bool inverted);

}  // namespace frangia
