#include "frangia/phase/blur/correct_pixel_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/blur/internal/phase_neighbours.h"

namespace frangia {
namespace {

/// The slope of a brightness along one axis by the means of three rows. At a border only a pixel
/// that lies on it has light of both sides: of the two changes the smaller one counts where they
/// differ by more than `noise`, the standard deviation of a pixel, explains.
float border_slope(float before, float here, float after, float noise) {
  constexpr float kSignificant = 5.0F;
  constexpr float kSharp = 0.5F;  // of their sum, by which changes differ that are no smooth ones
  const float back = here - before;
  const float on = after - here;
  const float differ = std::abs(on - back);
  const float noise_of_difference = 1.41F * noise;  // sqrt(6 / 3)
  if (differ <= kSignificant * noise_of_difference || differ <= kSharp * std::abs(back + on))
    return 0.5F * (back + on);
  if (back * on <= 0.0F) return 0.0F;
  return std::abs(back) < std::abs(on) ? back : on;
}

/// The gradient of a brightness.
Eigen::Vector2f brightness_slope(const Image<float>& counts, int x, int y, float noise) {
  const auto column = [&](int dx) {
    return (counts(x + dx, y - 1) + counts(x + dx, y) + counts(x + dx, y + 1)) / 3.0F;
  };
  const auto row = [&](int dy) {
    return (counts(x - 1, y + dy) + counts(x, y + dy) + counts(x + 1, y + dy)) / 3.0F;
  };
  return {border_slope(column(-1), column(0), column(1), noise),
          border_slope(row(-1), row(0), row(1), noise)};
}

constexpr int kWindow = 2 * kBlurReach + 1;  // px

/// Changes of the phase to the pixels around one, by rows.
using Window = Eigen::Matrix<float, kWindow, kWindow, Eigen::RowMajor>;

Window window_around(const PhaseNeighbours& neighbours) {
  Window window;
  for (int dy = -kBlurReach; dy <= kBlurReach; ++dy) {
    for (int dx = -kBlurReach; dx <= kBlurReach; ++dx)
      window(dy + kBlurReach, dx + kBlurReach) = neighbours.change(dx, dy);
  }
  return window;
}

/// The derivatives along the rows of a window; NaN where a pixel of its middle is missing.
struct Derivatives {
  float slope = 0.0F;
  float bend = 0.0F;
};

/// The mean over the rows that hold the three pixels around `column`; NaN without those of the
/// middle. Wider differences would be off beside a limb, where the bend grows with every pixel.
Derivatives derivatives_at(const Window& window, int column) {
  Derivatives sum;
  int rows = 0;
  for (int row = 0; row < kWindow; ++row) {
    const float before = window(row, column - 1);
    const float after = window(row, column + 1);
    const float bend = before - 2.0F * window(row, column) + after;
    const bool is_of_middle = std::abs(row - kBlurReach) <= 1;
    if (std::isnan(bend) && !is_of_middle) continue;
    sum.slope += 0.5F * (after - before);
    sum.bend += bend;
    ++rows;
  }
  const auto count = static_cast<float>(rows);
  return {sum.slope / count, sum.bend / count};
}

/// The derivatives in the middle of a window. At a crease only a pixel that lies on it has phases
/// of both sides: where the bends there and beside it differ by more than `noise`, the standard
/// deviation of a pixel, and a limb explain, the smallest one counts.
Derivatives derivatives_of(const Window& window, float noise) {
  constexpr float kSignificant = 4.0F;
  constexpr float kSharp = 0.3F;                   // of the largest one: less is no limb's
  const float noise_of_difference = 2.0F * noise;  // sqrt(20 / 5)
  Derivatives here = derivatives_at(window, kBlurReach);
  float least = here.bend;
  float most = here.bend;
  for (const int column : {kBlurReach - 1, kBlurReach + 1}) {
    const float beside = derivatives_at(window, column).bend;
    if (std::isnan(beside)) continue;
    least = std::min(least, beside);
    most = std::max(most, beside);
  }
  const auto [small, large] = std::minmax({std::abs(least), std::abs(most)});
  const bool is_sharp = small < kSharp * large || least * most < 0.0F;
  if (is_sharp && most - least > kSignificant * noise_of_difference)
    here.bend = least > 0.0F ? least : std::min(most, 0.0F);
  return here;
}

/// What the area of a pixel adds to its phase, over its variance; NaN where one of the eight
/// neighbours is missing, on another surface or on a border. `sigma_rad`: noise of the phase.
float area_error(
    const Image<float>& phase, const Image<float>& brightness, float sigma_rad, int x, int y) {
  const Window window = window_around({phase, nullptr, x, y});
  const Derivatives across = derivatives_of(window, sigma_rad);
  const Derivatives down = derivatives_of(window.transpose(), sigma_rad);
  // The relative noise of the modulation of N frames is the noise of their phase.
  const Eigen::Vector2f brighter =
      brightness_slope(brightness, x, y, sigma_rad * brightness(x, y)) / brightness(x, y);
  return brighter.dot(Eigen::Vector2f(across.slope, down.slope)) + 0.5F * (across.bend + down.bend);
}

}  // namespace

void correct_pixel_area(AbsolutePhase& phase,
                        const Image<float>& modulation_counts,
                        const PixelBox& box,
                        double variance_px2) {
  // Share by which the variance may be off: pixels do not use all of their area, and a blur that is
  // not noticed adds to it.
  constexpr float kOwn = 0.3F;
  const auto variance = static_cast<float>(variance_px2);
  require(modulation_counts.width() == box.width() && modulation_counts.height() == box.height(),
          "correct_pixel_area: the modulation does not cover the box");
  Image<float> before(box.width(), box.height(), Uninitialized{});
  for (int y = 0; y < box.height(); ++y)
    std::copy_n(&phase.phase_rad(box.left, box.top + y), box.width(), &before(0, y));
  parallel_rows(box.height(), [&](int y) {
    if (y < kBlurReach || y + kBlurReach >= box.height()) return;
    for (int x = kBlurReach; x + kBlurReach < box.width(); ++x) {
      if (std::isnan(before(x, y)) || !(modulation_counts(x, y) > 0.0F)) continue;
      const float sigma_rad = phase.sigma_rad(box.left + x, box.top + y);
      const float error = variance * area_error(before, modulation_counts, sigma_rad, x, y);
      if (std::isnan(error)) continue;
      phase.phase_rad(box.left + x, box.top + y) -= error;
      if (phase.systematic_rad.empty()) continue;
      float& systematic = phase.systematic_rad(box.left + x, box.top + y);
      systematic = std::hypot(systematic, kOwn * error);
    }
  });
}

}  // namespace frangia
