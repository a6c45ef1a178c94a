#include "frangia/local_fit/choose_window.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/local_fit/internal/fit_quadratic.h"

namespace frangia {
namespace {

/// Largest ratio of the residual variance of a quadratic to the expected one: the surface is
/// curved.
constexpr float kMaxCurvedRatio = 1.3F;

/// The same where the residuals are noisy: 3 times the known noise.
constexpr float kMaxNoisyRatio = 9.0F;

/// Largest ratio of the residual variance of a shifted window to that of the centered one.
constexpr float kMaxShiftedRatio = 0.5F;

/// Largest distance of a pixel from its plane, in standard deviations.
constexpr float kMaxOffSigmas = 4.0F;

const ChosenWindow kNoWindow{kNoFit, WindowKind::None, kMissing, kMissing};

/// The fit over the 3 x 3 pixels around (x, y); NaN as in `fit_windows`.
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
  // The quadratic's value: the mean minus the mean of its second-order terms.
  fit.value = fit.mean;
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1}) {
      fit.value -= (static_cast<float>(dx * dx + dy * dy) - 4.0F / 3.0F) * q(x + dx, y + dy) / 3.0F;
    }
  }
  return fit;
}

/// The best of the centered window and eight windows shifted by `shift`. A shifted window must be
/// better by a margin. `fit_at(x, y)` is the fit around a pixel.
template <typename FitAt>
WindowFit best_window(const Eigen::Vector2i& at, int shift, float max_ratio, const FitAt& fit_at) {
  WindowFit best = fit_at(at.x(), at.y());
  float limit = std::isnan(best.variance) ? std::numeric_limits<float>::infinity()
                                          : max_ratio * best.variance;
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

/// The quadratic fit around a pixel if its residuals are noise: no larger than expected, or, with
/// `noisy`, larger but without structure. The residuals at an edge have structure.
ChosenWindow curved_window(const Image<float>& image,
                           const Eigen::Vector2i& at,
                           const PixelNoise& noise,
                           const QuadraticFit& patch,
                           bool noisy,
                           const WindowChoiceOptions& options) {
  const float expected = noise.variance(patch.window);
  const float residual_variance = patch.window.residual_variance;
  const float max_ratio = noisy ? kMaxNoisyRatio : kMaxCurvedRatio;
  if (!(residual_variance < max_ratio * expected)) return kNoWindow;  // also for NaN
  const bool quiet = residual_variance < kMaxCurvedRatio * expected;
  if (!(noisy && quiet) &&
      !(residual_autocorrelation(image, at, patch.window) < options.max_autocorrelation))
    return kNoWindow;
  return {patch.window,
          WindowKind::Centered,
          patch.window.value,
          patch.variance * std::max(expected, quiet ? 0.0F : residual_variance)};
}

}  // namespace

ChosenWindow choose_window(const Image<float>& image,
                           const WindowRows& fits,
                           const Eigen::Vector2i& at,
                           const PixelNoise& noise,
                           const WindowChoiceOptions& options) {
  const auto centered_on = [&](const WindowFit& fit, int radius) {
    const float variance = value_variance(radius) * noise.variance(fit);
    return ChosenWindow{fit, WindowKind::Centered, fit.value, variance};
  };
  const auto good = [&](const WindowFit& fit) {
    return fit.variance < options.max_flat_ratio * noise.variance(fit);  // false for NaN
  };
  const auto near = [&](const WindowFit& fit) {
    const float off = fit.mean - image(at.x(), at.y());
    return off * off < kMaxOffSigmas * kMaxOffSigmas * noise.variance(fit);
  };
  const WindowFit centered = fits.at(at.x(), at.y());
  const auto patch = [&]() -> QuadraticFit {
    if (fits.radius != kQuadraticRadius || std::isnan(centered.mean))
      return fit_quadratic(image, at);
    QuadraticFit complete{centered, value_variance(kQuadraticRadius)};
    complete.window.mean = centered.value;
    complete.window.variance = centered.residual_variance;
    return complete;
  };
  if (good(centered)) return centered_on(centered, fits.radius);
  if (!std::isnan(centered.mean)) {
    const ChosenWindow curved = curved_window(image, at, noise, patch(), false, options);
    if (curved.kind == WindowKind::Centered) return curved;
  }
  const WindowFit close = small_fit(image, at.x(), at.y());
  if (good(close)) return centered_on(close, 1);
  const WindowFit large =
      best_window(at, fits.radius, kMaxShiftedRatio, [&](int x, int y) { return fits.at(x, y); });
  // Without a flat window to any side there is no edge: the surface is curved, or noisy.
  if (std::isnan(centered.mean) || !good(large)) {
    const ChosenWindow curved = curved_window(image, at, noise, patch(), true, options);
    if (curved.kind == WindowKind::Centered) return curved;
  }
  if (good(large) && near(large)) {
    return {large,
            WindowKind::Shifted,
            large.mean,
            corner_variance(fits.radius) * noise.variance(large)};
  }
  const WindowFit small =
      best_window(at, 1, kMaxShiftedRatio, [&](int x, int y) { return small_fit(image, x, y); });
  if (near(small)) return {small, WindowKind::Small, image(at.x(), at.y()), noise.variance(small)};
  return kNoWindow;
}

}  // namespace frangia
