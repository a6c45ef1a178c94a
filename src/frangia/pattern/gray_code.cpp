#include "frangia/pattern/gray_code.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/error.h"

namespace frangia {

bool is_stripe_bright(const Pattern& gray, int frame, double column) {
  const double stripe = std::floor((column + 0.5) / gray.stripe_px);
  const double last = std::ldexp(1.0, gray.bits) - 1.0;
  const std::uint32_t code =
      binary_to_gray(static_cast<std::uint32_t>(std::clamp(stripe, 0.0, last)));
  const int bit = gray.bits - 1 - frame % gray.bits;
  const bool bright = ((code >> static_cast<unsigned>(bit)) & 1U) != 0;
  return frame < gray.bits ? bright : !bright;
}

Pattern gray_code_for_fringes(const Pattern& fringes, double columns, bool inverted) {
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
