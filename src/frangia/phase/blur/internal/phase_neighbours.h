#pragma once

#include <algorithm>
#include <cmath>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"

namespace frangia {

/// Pixels around one from which the slopes there are found.
inline constexpr int kBlurReach = 2;

/// Change of the phase over a pixel along one axis: of both sides the smaller one, which does not
/// leave the surface.
inline float smaller_step(float before, float here, float after) {
  const float back = here - before;
  const float on = after - here;
  if (std::isnan(back)) return on;
  if (std::isnan(on)) return back;
  return std::abs(back) < std::abs(on) ? back : on;
}

/// The phase around a pixel, relative to it.
class PhaseNeighbours {
 public:
  /// `error_rad` is taken off the phase; null: nothing is.
  PhaseNeighbours(const Image<float>& phase, const Image<float>* error_rad, int x, int y)
      : phase_(phase), error_rad_(error_rad), x_(x), y_(y), here_(at(0, 0)) {
    constexpr float kSteeper = 2.0F;  // times the slope nearby, on the same surface
    for (const float step :
         {smaller_step(at(-1, 0), here_, at(1, 0)), smaller_step(at(0, -1), here_, at(0, 1))})
      if (std::isfinite(step)) most_ += kSteeper * std::abs(step);
  }
  /// The change of the phase to a neighbour, NaN where that is on another surface.
  [[nodiscard]] float change(int dx, int dy) const {
    const float change = at(dx, dy) - here_;
    const auto length = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
    return std::abs(change) <= most_ * std::max(1.0F, length) ? change : kMissing;
  }

 private:
  [[nodiscard]] float at(int dx, int dy) const {
    const float phase = phase_(x_ + dx, y_ + dy);
    return error_rad_ != nullptr ? phase - (*error_rad_)(x_ + dx, y_ + dy) : phase;
  }
  const Image<float>& phase_;
  const Image<float>* error_rad_;
  int x_;
  int y_;
  float here_;
  float most_ = 0.3F;  // change over a pixel of a rough surface, rad
};

}  // namespace frangia
