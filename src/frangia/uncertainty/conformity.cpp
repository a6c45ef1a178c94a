#include "frangia/uncertainty/conformity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frangia/core/error.h"

namespace frangia {

void ToleranceLimits::check() const {
  require(std::isfinite(lower) && std::isfinite(upper) && lower < upper,
          "the limits of a tolerance must be numbers, the lower one below the upper one");
}

Conformity conformity_of(double value,
                         double standard_uncertainty,
                         const ToleranceLimits& limits,
                         double guard_band) {
  const double guard = guard_band * standard_uncertainty;
  if (value >= limits.lower + guard && value <= limits.upper - guard) return Conformity::In;
  if (value < limits.lower - guard || value > limits.upper + guard) return Conformity::Out;
  return Conformity::Undecided;
}

double guard_band_of_many(std::size_t count) {
  const double tail = 0.05 / static_cast<double>(std::max<std::size_t>(count, 1));
  double low = 0.0;
  double high = 38.0;  // beyond it the tail of a double is 0
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const bool heavy = 0.5 * std::erfc(middle / std::numbers::sqrt2) > tail;
    (heavy ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace frangia
