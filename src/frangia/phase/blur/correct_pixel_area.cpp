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

/// The second derivative along a line by the means of five rows at the places -2 to 2. At a crease
/// only a pixel that lies on it has phases of both sides: where the derivatives at -1, 0 and 1
/// differ by more than `noise`, the standard deviation of a pixel, explains, the smallest one
/// counts.
float bend_along(const std::array<float, 5>& mean, float noise) {
  constexpr float kSignificant = 4.0F;
  const float noise_of_difference = 2.0F * noise;  // sqrt(20 / 5)
  const auto at = [&](std::size_t i) { return mean[i - 1] - 2.0F * mean[i] + mean[i + 1]; };
  const auto [least, most] = std::minmax({at(1), at(2), at(3)});
  if (most - least > kSignificant * noise_of_difference)
    return least > 0.0F ? least : std::min(most, 0.0F);
  // Of the parabola through all five, which has a fifth of the noise.
  return (2.0F * (mean[0] + mean[4]) - mean[1] - mean[3] - 2.0F * mean[2]) / 7.0F;
}

/// What the area of a pixel adds to its phase, over its variance; NaN where a neighbour is missing,
/// on another surface or on a border. `sigma_rad`: noise of the phase.
float area_error(
    const Image<float>& phase, const Image<float>& brightness, float sigma_rad, int x, int y) {
  const PhaseNeighbours neighbours(phase, nullptr, x, y);
  std::array<float, 5> columns{};
  std::array<float, 5> rows{};
  Eigen::Vector2f slope = Eigen::Vector2f::Zero();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const int dx = static_cast<int>(column) - kBlurReach;
      const int dy = static_cast<int>(row) - kBlurReach;
      const float change = neighbours.change(dx, dy);
      slope += change * Eigen::Vector2f(static_cast<float>(dx), static_cast<float>(dy)) / 50.0F;
      columns.at(column) += change / 5.0F;
      rows.at(row) += change / 5.0F;
    }
  }
  if (!slope.allFinite()) return kMissing;
  // The relative noise of the modulation of N frames is the noise of their phase.
  const float by_brightness =
      brightness_slope(brightness, x, y, sigma_rad * brightness(x, y)).dot(slope);
  const float bend = bend_along(columns, sigma_rad) + bend_along(rows, sigma_rad);
  return by_brightness / brightness(x, y) + 0.5F * bend;
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
