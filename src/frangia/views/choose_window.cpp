#include "frangia/views/choose_window.h"

#include <algorithm>
#include <cmath>

#include "frangia/views/fit_patch.h"

namespace frangia {
namespace {

const ChosenWindow kNoWindow{kNoFit, WindowKind::None, 1.0F, 0.0F};

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
  // Of the best paraboloid: the mean less what its curvature lifts the mean by.
  fit.middle = fit.mean;
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1})
      fit.middle -=
          (static_cast<float>(dx * dx + dy * dy) - 4.0F / 3.0F) * q(x + dx, y + dy) / 3.0F;
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

/// The best paraboloid about a pixel where what it leaves over is noise: as much as is expected,
/// or more of it than the phase knows of, but without structure. An edge leaves structure over.
ChosenWindow round_window(const PatchFit& patch, const PixelNoise& noise, bool loud) {
  constexpr float kRound = 1.3F;   // in variance
  constexpr float kUneven = 2.0F;  // pixels differ in their noise
  constexpr float kLoud = 9.0F;
  constexpr float kStructure = 0.0F;
  constexpr float kNone = -0.08F;  // what most noise is below, and hardly an edge
  const float expected = noise.variance(patch.window);
  const float rest = patch.window.rest;
  const float structure = patch.window.structure;
  const bool quiet = rest < kRound * expected;
  const float most = loud ? kLoud : structure < kNone ? kUneven : kRound;
  const bool noisy = structure < kStructure && rest < most * expected;
  if (!noisy && !(loud && quiet)) return kNoWindow;  // and for NaN
  return {patch.window,
          WindowKind::Centred,
          patch.variance,
          std::sqrt(std::max(expected, quiet ? 0.0F : rest))};
}

/// The paraboloid of a whole window, as `fit_patch` has it.
PatchFit whole_patch(const WindowFit& fit, int radius) {
  PatchFit patch{fit, middle_variance(radius)};
  patch.window.mean = fit.middle;
  patch.window.variance = fit.rest;
  return patch;
}

/// A window that follows the surface, with the middle of the wider one about the same pixel where
/// that follows it, too.
ChosenWindow widened(ChosenWindow chosen, const WindowFit& wide, int radius) {
  constexpr float kUneven = 2.5F;  // in variance
  constexpr float kSame = 0.7F;    // of a pixel's noise: two and a half times what chance does
  constexpr float kStructure = 0.05F;
  const float expected = chosen.noise * chosen.noise;
  const float off = wide.middle - chosen.fit.middle;
  if (wide.structure < kStructure && wide.rest < kUneven * expected &&
      off * off < kSame * kSame * expected) {
    chosen.fit.middle = wide.middle;
    chosen.kind = WindowKind::Wide;
    chosen.variance = middle_variance(radius);
  }
  return chosen;
}

}  // namespace

ChosenWindow choose_window(const Image<float>& image,
                           const WindowRows& fits,
                           const Eigen::Vector2i& at,
                           const PixelNoise& noise,
                           const WindowRows* wider) {
  constexpr float kFits = 2.0F;      // in variance
  constexpr float kFarthest = 4.0F;  // sigmas that a pixel may lie off its plane
  constexpr float kAtCorner = 0.2F;  // of a pixel's variance, what a plane has at a corner
  const auto chosen = [&](const WindowFit& fit, WindowKind kind, float variance) {
    return ChosenWindow{fit, kind, variance, std::sqrt(noise.variance(fit))};
  };
  const auto good = [&](const WindowFit& fit) {
    return fit.variance < kFits * noise.variance(fit);  // false for NaN
  };
  const auto near = [&](const WindowFit& fit) {
    const float off = fit.mean - image(at.x(), at.y());
    return off * off < kFarthest * kFarthest * noise.variance(fit);
  };
  const auto follows = [&](const ChosenWindow& found) {
    return wider == nullptr ? found : widened(found, wider->at(at.x(), at.y()), wider->radius);
  };
  const WindowFit& centred = fits.at(at.x(), at.y());
  if (good(centred))
    return follows(chosen(centred, WindowKind::Centred, middle_variance(fits.radius)));
  const bool whole = !std::isnan(centred.mean);
  if (whole) {
    const ChosenWindow round = round_window(whole_patch(centred, fits.radius), noise, false);
    if (round.kind == WindowKind::Centred) return follows(round);
    // What looks like structure in few pixels may be seen as noise among more of them.
    const ChosenWindow found =
        follows(chosen(whole_patch(centred, fits.radius).window, WindowKind::Centred, 1.0F));
    if (found.kind == WindowKind::Wide) return found;
  }
  const WindowFit close = small_fit(image, at.x(), at.y());
  if (good(close)) return chosen(close, WindowKind::Centred, middle_variance(1));
  const WindowFit large = best_window(at, fits.radius, [&](int x, int y) { return fits.at(x, y); });
  // Where no window to one side is flat there is no edge either: the surface is round, or noisy.
  if (!whole || !good(large)) {
    const ChosenWindow round =
        round_window(whole ? whole_patch(centred, fits.radius) : fit_patch(image, at), noise, true);
    if (round.kind == WindowKind::Centred) return round;
  }
  if (good(large) && near(large)) return chosen(large, WindowKind::Beside, kAtCorner);
  const WindowFit small = best_window(at, 1, [&](int x, int y) { return small_fit(image, x, y); });
  if (near(small)) return chosen(small, WindowKind::Small, 1.0F);
  return kNoWindow;
}

}  // namespace frangia
