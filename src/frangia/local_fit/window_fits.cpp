#include "frangia/local_fit/window_fits.h"

#include <algorithm>

namespace frangia {

WindowFits::WindowFits(int width, int rows)
    : width_(width),
      values_(std::make_unique_for_overwrite<float[]>(  // NOLINT(*-avoid-c-arrays)
          static_cast<std::size_t>(width) * static_cast<std::size_t>(rows * QuantityCount))) {}

void WindowFits::set_missing_outside(int begin, int end, int row) {
  for (int quantity = 0; quantity < QuantityCount; ++quantity) {
    float* values = this->row(static_cast<Quantity>(quantity), row);
    std::fill(values, values + begin, kMissing);
    std::fill(values + end, values + width_, kMissing);
  }
}

WindowFit WindowFits::at(int x, int row) const {
  const float* first = values_.get() + offset(Mean, row) + x;
  const auto quantity = [&](Quantity which) { return first[std::ptrdiff_t{width_} * which]; };
  return {quantity(Mean),
          quantity(SlopeX),
          quantity(SlopeY),
          quantity(Variance),
          quantity(Value),
          quantity(ResidualVariance),
          quantity(CurvatureXX),
          quantity(CurvatureYY),
          quantity(CurvatureXY)};
}

}  // namespace frangia
