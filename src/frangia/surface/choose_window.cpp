#include "frangia/surface/choose_window.h"

#include <cmath>

namespace frangia {
namespace {

/// The window of 3 x 3 pixels about (x, y), by hand; NaN as in `fit_windows`.
WindowFit small_fit(const Image<float>& q, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= q.width() || y + 1 >= q.height()) {
    return kNoFit;
  }
  WindowFit fit;
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1}) {
      const float value = q(x + dx, y + dy);
      fit.mean += value / 9.0F;
      fit.slope_x += static_cast<float>(dx) * value / 6.0F;
      fit.slope_y += static_cast<float>(dy) * value / 6.0F;
    }
  }
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1}) {
      const float plane =
          fit.mean + static_cast<float>(dx) * fit.slope_x + static_cast<float>(dy) * fit.slope_y;
      fit.variance += (q(x + dx, y + dy) - plane) * (q(x + dx, y + dy) - plane) / 6.0F;
    }
  }
  return fit;
}

/// Of a pixel's own window and eight shifted by `shift`, the best one; its own unless another is
/// clearly better. `fit_at(x, y)` is the fit about a pixel.
template <typename FitAt>
WindowFit best_window(const Eigen::Vector2i& at, int shift, const FitAt& fit_at) {
  constexpr float kClearlyBetter = 0.5F;  // in variance
  WindowFit best = fit_at(at.x(), at.y());
  float limit = std::isnan(best.variance) ? 1e30F : kClearlyBetter * best.variance;
  for (const int dy : {-shift, 0, shift}) {
    for (const int dx : {-shift, 0, shift}) {
      const WindowFit shifted = fit_at(at.x() + dx, at.y() + dy);
      if (!(shifted.variance < limit)) continue;
      limit = shifted.variance;
      best = shifted;
      best.mean -=
          static_cast<float>(dx) * shifted.slope_x + static_cast<float>(dy) * shifted.slope_y;
    }
  }
  return best;
}

}  // namespace

WindowFit choose_window(const Image<float>& image,
                        const WindowRows& fits,
                        const Eigen::Vector2i& at,
                        float noise) {
  constexpr float kFits = 2.0F;      // in variance
  constexpr float kFarthest = 4.0F;  // sigmas that a pixel may lie off its plane
  const float good = kFits * noise * noise;
  const WindowFit& centred = fits.at(at.x(), at.y());
  if (centred.variance < good) return centred;
  const WindowFit large = best_window(at, fits.radius, [&](int x, int y) { return fits.at(x, y); });
  const auto off = [&](const WindowFit& fit) { return std::abs(fit.mean - image(at.x(), at.y())); };
  if (large.variance < good && off(large) < kFarthest * noise) return large;
  const WindowFit small = best_window(at, 1, [&](int x, int y) { return small_fit(image, x, y); });
  if (off(small) < kFarthest * noise) return small;
  return kNoFit;
}

}  // namespace frangia
