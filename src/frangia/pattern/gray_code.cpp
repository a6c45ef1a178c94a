#include "frangia/pattern/gray_code.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/error.h"

namespace frangia {

int frame_of_bit(const Pattern& gray, int bit, bool is_inverse) {
  const int place = gray.order == BitOrder::MostSignificantFirst ? bit : gray.bits - 1 - bit;
  if (gray.inverted == InvertedFrames::Alternating) return 2 * place + (is_inverse ? 1 : 0);
  return is_inverse ? gray.bits + place : place;
}

std::uint32_t code_of_stripe(const Pattern& gray, std::uint32_t stripe) {
  return gray.is_binary ? stripe : binary_to_gray(stripe);
}

std::uint32_t stripe_of_code(const Pattern& gray, std::uint32_t code) {
  return gray.is_binary ? code : gray_to_binary(code);
}

double column_of_code(const Pattern& gray, std::uint32_t code) {
  return (stripe_of_code(gray, code) + 0.5) * gray.stripe_px - 0.5 - gray.offset_px;
}

bool is_stripe_bright(const Pattern& gray, int frame, double column) {
  const double stripe = std::floor((column + 0.5 + gray.offset_px) / gray.stripe_px);
  const double last = std::ldexp(1.0, gray.bits) - 1.0;
  const std::uint32_t code =
      code_of_stripe(gray, static_cast<std::uint32_t>(std::clamp(stripe, 0.0, last)));
  for (int bit = 0; bit < gray.bits; ++bit) {
    const bool bright = ((code >> static_cast<unsigned>(gray.bits - 1 - bit)) & 1U) != 0;
    if (frame_of_bit(gray, bit, false) == frame) return bright;
    if (gray.inverted != InvertedFrames::None && frame_of_bit(gray, bit, true) == frame)
      return !bright;
  }
  throw Error(ErrorKind::Input, "is_stripe_bright: the pattern has no such frame");
}

Pattern gray_code_for_fringes(const Pattern& fringes, double columns, InvertedFrames inverted) {
  const double stripe = 0.5 * fringes.period_px;
  require(std::isfinite(stripe) && stripe >= 1.0,
          "Gray code needs fringes of two projector pixels or more; make them wider");
  Pattern gray{.name = "gray", .kind = PatternKind::Gray, .direction = fringes.direction};
  gray.stripe_px = stripe;
  gray.bits = std::max(1, static_cast<int>(std::ceil(std::log2(columns / stripe) - 1e-9)));
  gray.inverted = inverted;
  return gray;
}

}  // namespace frangia
