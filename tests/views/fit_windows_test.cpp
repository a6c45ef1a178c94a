#include "frangia/views/fit_windows.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

Image<float> slope() {
  Image<float> image(20, 12);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 20; ++x)
      image(x, y) = 3.0F + 0.5F * static_cast<float>(x) - 0.25F * static_cast<float>(y);
  }
  return image;
}

TEST(FitWindows, RecoversAPlaneAtEveryRadius) {
  for (const int radius : {1, 2, 3}) {
    Image<WindowFit> fits(20, 4);
    fit_windows(slope(), radius, 4, fits);
    const WindowFit& fit = fits(7, 1);  // pixel (7, 5)
    EXPECT_NEAR(fit.mean, 3.0 + 3.5 - 1.25, 1e-5);
    EXPECT_NEAR(fit.slope_x, 0.5, 1e-5);
    EXPECT_NEAR(fit.slope_y, -0.25, 1e-5);
    EXPECT_NEAR(fit.variance, 0.0, 1e-9);
  }
}

TEST(FitWindows, MeasuresTheScatterAboutThePlane) {
  Image<float> image = slope();
  image(7, 5) += 1.0F;
  Image<WindowFit> fits(20, 1);
  fit_windows(image, 1, 5, fits);
  EXPECT_NEAR(fits(7, 0).variance, (8.0 / 9.0) / 6.0, 1e-5);  // what one of nine leaves, over 9 - 3
}

TEST(FitWindows, LeavesOutWindowsWithAHoleOrOverTheRim) {
  Image<float> image = slope();
  image(7, 5) = kMissing;
  Image<WindowFit> fits(20, 12);
  fit_windows(image, 2, 0, fits);
  EXPECT_TRUE(std::isnan(fits(9, 7).mean));
  EXPECT_FALSE(std::isnan(fits(10, 7).mean));
  EXPECT_TRUE(std::isnan(fits(1, 7).mean));
  EXPECT_TRUE(std::isnan(fits(12, 10).mean));
}

TEST(FitWindows, TellsNoiseFromAnEdgeHoweverLoudItIs) {
  for (const int radius : {2, 3}) {
    Image<float> edge(20, 12);
    Image<float> noise(20, 12);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 20; ++x) {
        edge(x, y) = static_cast<float>(std::abs(x - 9));
        noise(x, y) =
            100.0F * static_cast<float>(uniform_from(hash(static_cast<std::uint64_t>(x + 20 * y))));
      }
    }
    Image<WindowFit> fits(20, 4);
    fit_windows(edge, radius, 4, fits);
    EXPECT_GT(fits(8, 1).structure, 0.1F);  // a pixel beside the edge
    fit_windows(noise, radius, 4, fits);
    float sum = 0.0F;
    for (int y = 0; y < 4; ++y) {
      for (int x = 3; x < 17; ++x)
        sum += fits(x, y).structure;
    }
    EXPECT_LT(sum / 56.0F, -0.05F);
  }
}

TEST(FitWindows, RefusesOtherRadii) {
  Image<WindowFit> fits(20, 1);
  EXPECT_THROW(fit_windows(slope(), 4, 5, fits), Error);
}

}  // namespace
}  // namespace frangia
