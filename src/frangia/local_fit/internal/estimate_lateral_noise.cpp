#include "frangia/local_fit/internal/estimate_lateral_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/core/parallel.h"
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

}  // namespace frangia
