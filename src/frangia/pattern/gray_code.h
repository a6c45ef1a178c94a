#pragma once

#include <cstdint>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// The reflected binary code. Neighbouring numbers differ in one bit, so a pixel on the edge
/// between two stripes reads one of the two numbers.
///
/// @source   Gray 1953, US patent 2 632 058
[[nodiscard]] constexpr std::uint32_t binary_to_gray(std::uint32_t number) {
  return number ^ (number >> 1U);
}
/// Inverts `binary_to_gray`.
[[nodiscard]] constexpr std::uint32_t gray_to_binary(std::uint32_t gray) {
  for (std::uint32_t shift = 1; shift < 32; shift *= 2)
    gray ^= gray >> shift;
  return gray;
}

/// Returns the number of the frame that shows a bit, or of the one that shows it inverted. Bit 0 is
/// the most significant one.
[[nodiscard]] int frame_of_bit(const Pattern& gray, int bit, bool is_inverse);

/// Returns the code of a stripe: Gray code, or the number itself for a binary code.
[[nodiscard]] std::uint32_t code_of_stripe(const Pattern& gray, std::uint32_t stripe);
/// Inverts `code_of_stripe`.
[[nodiscard]] std::uint32_t stripe_of_code(const Pattern& gray, std::uint32_t code);

/// Returns the projector column (or row) at the centre of the stripe with a code. Column k has its
/// centre at k.
[[nodiscard]] double column_of_code(const Pattern& gray, std::uint32_t code);

/// Returns whether a frame of a Gray code pattern lights the stripe at `column` (or row) of the
/// projector. Column k has its centre at k.
[[nodiscard]] bool is_stripe_bright(const Pattern& gray, int frame, double column);

/// Returns a Gray code over `columns` projector pixels with stripes half a fringe wide. A stripe
/// misread as its neighbour then still gives the correct fringe order.
///
/// @errors   Error(Input) unless half a fringe is finite and at least one pixel wide
[[nodiscard]] Pattern gray_code_for_fringes(const Pattern& fringes,
                                            double columns,
                                            InvertedFrames inverted);

}  // namespace frangia
