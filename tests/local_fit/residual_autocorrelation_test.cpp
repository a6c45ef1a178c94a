#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/local_fit/internal/estimate_lateral_noise.h"

namespace frangia {
namespace {

std::vector<float> autocorrelation_of_row(const Image<float>& image, int y) {
  std::vector<float> autocorrelation(static_cast<std::size_t>(image.width()));
  window_autocorrelation(image, WindowRows(image, 3, 0, image.height()), y, autocorrelation);
  return autocorrelation;
}

TEST(WindowAutocorrelation, IsPositiveWhereverAnEdgeRunsThroughTheWindow) {
  Image<float> edge(20, 12);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 20; ++x)
      edge(x, y) = static_cast<float>(std::abs(x - 9));
  }
  const auto autocorrelation = autocorrelation_of_row(edge, 5);
  for (std::size_t x = 7; x < 12; ++x)
    EXPECT_GT(autocorrelation[x], 0.2F) << x;
}

TEST(WindowAutocorrelation, IsNegativeForNoiseOfAnyAmplitude) {
  for (const float amplitude : {0.001F, 100.0F}) {
    Image<float> noise(200, 12);
    for (std::size_t i = 0; i < noise.pixels().size(); ++i)
      noise.pixels()[i] = amplitude * static_cast<float>(uniform_from(hash(std::uint64_t{i})));
    const auto autocorrelation = autocorrelation_of_row(noise, 5);
    float sum = 0.0F;
    for (std::size_t x = 3; x < 197; ++x)
      sum += autocorrelation[x];
    EXPECT_LT(sum / 194.0F, -0.08F);
  }
}

TEST(WindowAutocorrelation, IsMissingWithoutAWindow) {
  Image<float> image(20, 12, 1.0F);
  image(8, 5) = std::nanf("");
  const auto autocorrelation = autocorrelation_of_row(image, 5);
  EXPECT_TRUE(std::isnan(autocorrelation[2]));
  EXPECT_TRUE(std::isnan(autocorrelation[8]));
  EXPECT_FALSE(std::isnan(autocorrelation[4]));
  EXPECT_TRUE(std::isnan(autocorrelation_of_row(image, 2)[10]));
}

TEST(WindowAutocorrelation, RefusesOtherWindows) {
  const Image<float> image(20, 12, 1.0F);
  std::vector<float> autocorrelation(20);
  EXPECT_THROW(window_autocorrelation(image, WindowRows(image, 2, 0, 12), 5, autocorrelation),
               Error);
}

}  // namespace
}  // namespace frangia
