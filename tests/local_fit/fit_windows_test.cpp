#include "frangia/local_fit/fit_windows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"

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
    const WindowFit fit = fit_windows(slope(), radius, 4, 4).at(7, 1);  // pixel (7, 5)
    EXPECT_NEAR(fit.mean, 3.0 + 3.5 - 1.25, 1e-5);
    EXPECT_NEAR(fit.slope_x, 0.5, 1e-5);
    EXPECT_NEAR(fit.slope_y, -0.25, 1e-5);
    EXPECT_NEAR(fit.variance, 0.0, 1e-9);
  }
}

TEST(FitWindows, MeasuresTheScatterAboutThePlane) {
  Image<float> image = slope();
  image(7, 5) += 1.0F;
  const WindowFits fits = fit_windows(image, 1, 5, 1);
  EXPECT_NEAR(
      fits.at(7, 0).variance, (8.0 / 9.0) / 6.0, 1e-5);  // residuals of one in nine, over 9 - 3
}

TEST(FitWindows, AreMissingAtAHoleAndAtTheBorder) {
  Image<float> image = slope();
  image(7, 5) = kMissing;
  const WindowFits fits = fit_windows(image, 2, 0, 12);
  EXPECT_TRUE(std::isnan(fits.at(9, 7).mean));
  EXPECT_FALSE(std::isnan(fits.at(10, 7).mean));
  EXPECT_TRUE(std::isnan(fits.at(1, 7).mean));
  EXPECT_TRUE(std::isnan(fits.at(12, 10).mean));
}

TEST(FitWindows, RefusesOtherRadii) {
  EXPECT_THROW(static_cast<void>(fit_windows(slope(), 4, 5, 1)), Error);
}

}  // namespace
}  // namespace frangia
