#include "frangia/phase/internal/fringe_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/lane_math.h"

namespace frangia {
namespace {

/// Adds the residuals of one map in all orders of the finest one.
FRANGIA_VECTORIZED void add_residuals(float phase_rad,
                                      float ratio,
                                      std::size_t orders,
                                      const float* __restrict absolute,
                                      float* __restrict square,
                                      float* __restrict along) {
  for (std::size_t i = 0; i < orders; ++i) {
    const float residual = wrap_lane(phase_rad - ratio * absolute[i]);
    square[i] += residual * residual;
    along[i] += residual * ratio;
  }
}

}  // namespace

FringeCurve::FringeCurve(std::vector<double> per_unit, double first, double last)
    : per_unit_(std::move(per_unit)), first_(first), last_(last) {
  require(!per_unit_.empty(), "FringeCurve: no map is given");
  finest_ = static_cast<std::size_t>(std::max_element(per_unit_.begin(), per_unit_.end()) -
                                     per_unit_.begin());
  for (const double frequency : per_unit_) {
    const double ratio = frequency / per_unit_[finest_];
    slope_weight_ += ratio * ratio;
  }
}

FringeCurve::Nearest FringeCurve::nearest(std::span<const float> phases_rad) {
  const double top = per_unit_[finest_];
  const double wrapped = phases_rad[finest_];
  // One order beyond each end, so that noise at the ends of the field costs little.
  const double lowest = std::ceil(top * first_ - wrapped / kTwoPi - 0.5);
  const double highest = std::floor(top * last_ - wrapped / kTwoPi + 0.5);
  const auto orders = static_cast<std::size_t>(std::max(0.0, highest - lowest) + 1.0);
  absolute_.resize(orders);
  along_.assign(orders, 0.0F);
  square_.resize(orders);
  const double low_rad = kTwoPi * top * first_;
  const double high_rad = kTwoPi * top * last_;
  for (std::size_t i = 0; i < orders; ++i) {
    const double at = wrapped + kTwoPi * (lowest + static_cast<double>(i));
    const double outside = std::max({low_rad - at, at - high_rad, 0.0});
    absolute_[i] = static_cast<float>(at);
    square_[i] = static_cast<float>(outside * outside);
  }
  for (std::size_t m = 0; m < per_unit_.size(); ++m) {
    if (m == finest_) continue;  // its residual is 0 in every order
    add_residuals(phases_rad[m],
                  static_cast<float>(per_unit_[m] / top),
                  orders,
                  absolute_.data(),
                  square_.data(),
                  along_.data());
  }
  Nearest out{std::numeric_limits<float>::max(), 0.0F};
  for (std::size_t i = 0; i < orders; ++i) {
    const auto shift = static_cast<float>(along_[i] / slope_weight_);  // along the curve
    const float found = square_[i] - along_[i] * shift;
    if (found >= out.distance_rad) continue;
    out.distance_rad = found;
    out.unit = static_cast<float>((absolute_[i] + shift) / (kTwoPi * top));
  }
  out.distance_rad = std::sqrt(std::max(0.0F, out.distance_rad));
  return out;
}

}  // namespace frangia
