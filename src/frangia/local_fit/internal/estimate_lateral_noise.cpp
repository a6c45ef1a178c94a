#include "frangia/local_fit/internal/estimate_lateral_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/core/vectorized.h"
#include "frangia/local_fit/fit_windows.h"

namespace frangia {
namespace {

constexpr int kSlopeRadius = 2;
constexpr int kEvery = 6;                 // row spacing of the samples in a small image
constexpr int kMaxRows = 100;             // number of sampled rows in a large image
constexpr std::size_t kMinWindows = 200;  // fewer give no estimate
constexpr float kMax_px = 0.5F;           // half a pixel: the measured position is inside the pixel
constexpr float kSteepestShare = 0.25F;   // share of the windows that is used, from the steepest

/// The estimate from one window.
struct Slope {
  float steepness;         ///< slope^2 over noise^2
  float lateral_variance;  ///< (residual variance - noise^2) / slope^2
};

std::vector<Slope> slopes_of_row(const Image<float>& image, const Image<float>& noise, int y) {
  std::vector<Slope> slopes;
  const WindowFits fits = fit_windows(image, kSlopeRadius, y, 1);
  for (int x = 0; x < image.width(); ++x) {
    const WindowFit fit = fits.at(x, 0);
    const float expected = noise(x, y) * noise(x, y);
    const float square = fit.slope_x * fit.slope_x + fit.slope_y * fit.slope_y;
    if (!(fit.residual_variance >= 0.0F && square > 0.0F && expected > 0.0F)) continue;
    slopes.push_back({square / expected, (fit.residual_variance - expected) / square});
  }
  return slopes;
}

std::vector<Slope> slopes_of(const Image<float>& image,
                             const Image<float>& noise,
                             const ImageStrip& strip) {
  const int every = std::max(kEvery, strip.full_height / kMaxRows);
  const int rows = std::max(0, strip.full_height - 2 * kSlopeRadius + every - 1) / every;
  std::vector<std::vector<Slope>> parts(static_cast<std::size_t>(rows));
  parallel_rows(rows, [&](int row) {
    const int y = kSlopeRadius + row * every - strip.top;
    if (y < 0 || y >= image.height()) return;
    parts[static_cast<std::size_t>(row)] = slopes_of_row(image, noise, y);
  });
  std::vector<Slope> slopes;
  for (const auto& part : parts)
    slopes.insert(slopes.end(), part.begin(), part.end());
  return slopes;
}

}  // namespace

float estimate_lateral_noise(const Image<float>& image,
                             const Image<float>& noise,
                             const std::optional<ImageStrip>& strip) {
  std::vector<Slope> slopes =
      slopes_of(image, noise, strip.value_or(ImageStrip{0, image.height()}));
  if (slopes.size() < kMinWindows) return 0.0F;
  const auto steep =
      slopes.begin() +
      static_cast<std::ptrdiff_t>((1.0F - kSteepestShare) * static_cast<float>(slopes.size()));
  std::nth_element(slopes.begin(), steep, slopes.end(), [](const Slope& a, const Slope& b) {
    return a.steepness < b.steepness;
  });
  std::vector<float> variances;
  std::transform(steep, slopes.end(), std::back_inserter(variances), [](const Slope& slope) {
    return slope.lateral_variance;
  });
  return std::min(kMax_px, std::sqrt(std::max(0.0F, median(std::move(variances)))));
}

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
