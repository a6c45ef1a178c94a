#include "frangia/phase/internal/row_smoother.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr int kWidth = 50;
constexpr int kHeight = 9;
constexpr int kRadius = 2;

/// A slope with noise, some outliers and some missing pixels.
AbsolutePhase noisy_slope() {
  AbsolutePhase phase;
  phase.phase_rad = Image<float>(kWidth, kHeight);
  phase.sigma_rad = Image<float>(kWidth, kHeight, 0.1F);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      const double outlier = hash(2, i) % 5 == 0 ? 3.0 : 0.0;
      const bool missing = hash(3, i) % 6 == 0;
      phase.phase_rad(x, y) =
          missing ? kMissing
                  : static_cast<float>(0.01 * x + 0.1 * normal_from(hash(1, i)) + outlier);
    }
  }
  return phase;
}

/// The mean at one pixel, by its definition.
double mean_at(const Image<float>& phase, int x, int y) {
  const double center = phase(x, y);
  const auto agrees = [&](int u, int v) {
    return u >= 0 && v >= 0 && u < kWidth && v < kHeight &&
           std::abs(phase(u, v) - center) < 3.0 * 1.414 * 0.1;
  };
  double sum = 0.0;
  double count = 0.0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      if (!agrees(x + dx, y + dy) || !agrees(x - dx, y - dy)) continue;
      sum += phase(x + dx, y + dy);
      count += 1.0;
    }
  }
  return sum / count;
}

TEST(RowSmoother, TakesTheMeanOfTheNeighborsThatAgree) {
  const AbsolutePhase phase = noisy_slope();
  RowSmoother smoother(phase, kRadius);
  int smoothed = 0;
  for (int y = 0; y < kHeight; ++y) {
    smoother.smooth(y);
    for (int x = 0; x < kWidth; ++x) {
      if (std::isnan(phase.phase_rad(x, y))) {
        EXPECT_TRUE(std::isnan(smoother.phase_rad()[x]));
        continue;
      }
      EXPECT_NEAR(smoother.phase_rad()[x], mean_at(phase.phase_rad, x, y), 1e-6) << x << " " << y;
      EXPECT_LE(smoother.sigma_rad()[x], 0.1F);
      smoothed += smoother.sigma_rad()[x] < 0.1F ? 1 : 0;
    }
  }
  EXPECT_GT(smoothed, 200);
}

}  // namespace
}  // namespace frangia
