#include "frangia/local_fit/internal/residual_autocorrelation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

constexpr int kWindowRadius = 3;
constexpr int kWindowSide = 2 * kWindowRadius + 1;
constexpr float kSquare = kWindowRadius * (kWindowRadius + 1) / 3.0F;  // mean of x^2

constexpr float quadratic(int i) {
  return static_cast<float>((i - kWindowRadius) * (i - kWindowRadius)) - kSquare;
}

/// Number of neighbour pairs along a side that an element belongs to.
constexpr float neighbor_pairs(int i) {
  return i == 0 || i + 1 == kWindowSide ? 1.0F : 2.0F;
}

struct FitRows {
  const float* mean;
  const float* slope_x;
  const float* slope_y;
  const float* curvature_xx;
  const float* curvature_yy;
  const float* curvature_xy;
};

FRANGIA_VECTORIZED_WIDE void correlate(const float* top,
                                       std::ptrdiff_t width,
                                       const FitRows& rows,
                                       std::span<float> autocorrelation) {
  const FitRows fit = rows;
  float* to = autocorrelation.data();
  const auto count = static_cast<std::ptrdiff_t>(autocorrelation.size());
#pragma GCC ivdep
  for (std::ptrdiff_t x = 0; x < count; ++x) {
    float products = 0.0F;
    float paired = 0.0F;
    std::array<float, kWindowSide> above{};
#pragma GCC unroll 7  // the loop over x vectorizes only without inner loops
    for (int j = 0; j < kWindowSide; ++j) {
      const auto down = static_cast<float>(j - kWindowRadius);
      const float row_mean =
          fit.mean[x] + down * fit.slope_y[x] + quadratic(j) * fit.curvature_yy[x];
      const float along = fit.slope_x[x] + down * fit.curvature_xy[x];
      float before = 0.0F;
#pragma GCC unroll 7
      for (int i = 0; i < kWindowSide; ++i) {
        const float fitted = row_mean + static_cast<float>(i - kWindowRadius) * along +
                             quadratic(i) * fit.curvature_xx[x];
        const float off = top[j * width + x + i] - fitted;
        const auto column = static_cast<std::size_t>(i);
        paired += (neighbor_pairs(i) + neighbor_pairs(j)) * off * off;
        products += off * (before + above[column]);
        above[column] = before = off;
      }
    }
    to[x] = paired == 0.0F ? 0.0F : 2.0F * products / paired;  // NaN stays
  }
}

}  // namespace

void window_autocorrelation(const Image<float>& image,
                            const WindowRows& windows,
                            int y,
                            std::span<float> autocorrelation) {
  require(windows.radius == kWindowRadius,
          "window_autocorrelation: the windows must be 7 x 7 pixels");
  std::fill(autocorrelation.begin(), autocorrelation.end(), kMissing);
  const int top = y - kWindowRadius;
  if (top < 0 || top + kWindowSide > image.height() || image.width() < kWindowSide) return;
  const float* mean = windows.fits.row(WindowFits::Mean, y - windows.first);
  const auto seen = [](float value) { return !std::isnan(value); };
  const float* first = std::find_if(mean, mean + image.width(), seen);
  if (first == mean + image.width()) return;
  const float* end = mean + image.width();
  while (!seen(end[-1]))
    --end;
  const std::ptrdiff_t begin = first - mean;
  const auto of = [&](WindowFits::Quantity quantity) {
    return windows.fits.row(quantity, y - windows.first) + begin;
  };
  correlate(&image(0, top) + begin - kWindowRadius,
            image.width(),
            {of(WindowFits::Mean),
             of(WindowFits::SlopeX),
             of(WindowFits::SlopeY),
             of(WindowFits::CurvatureXX),
             of(WindowFits::CurvatureYY),
             of(WindowFits::CurvatureXY)},
            autocorrelation.subspan(static_cast<std::size_t>(begin),
                                    static_cast<std::size_t>(end - first)));
}

}  // namespace frangia
