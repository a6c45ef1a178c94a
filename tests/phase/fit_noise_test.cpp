#include "frangia/phase/wrap/internal/fit_noise.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace frangia::phase {
namespace {

constexpr double kSamples = 5000.0;

/// Variances at some brightnesses, by a curve.
template <typename Curve>
std::vector<VarianceAt> variances_of(const Curve& curve) {
  std::vector<VarianceAt> out;
  for (double counts = 8.0; counts < 230.0; counts += 12.0)
    out.push_back({counts, curve(counts), kSamples});
  return out;
}

TEST(FitNoise, IsAStraightLineWhereTheNoiseGrowsWithBrightness) {
  const NoiseModel model =
      fit_noise(variances_of([](double counts) { return 0.5 + counts / 40.0; }), {}, 255);
  EXPECT_NEAR(model.floor_counts2, 0.5, 1e-9);
  EXPECT_NEAR(model.slope_counts, 1.0 / 40.0, 1e-9);
  EXPECT_EQ(model.dark_counts2, 0.0);
}

TEST(FitNoise, FollowsTheNoiseOfEncodedLight) {
  // d counts / d light of counts ~ light^(1 / 2.2), with shot noise and read noise.
  const auto truth = [](double counts) {
    const double light = std::pow(counts / 255.0, 2.2);
    const double slope = 255.0 / 2.2 * std::pow(counts / 255.0, -1.2);
    return slope * slope * (light / 3000.0 + std::pow(12.0 / 3000.0, 2));
  };
  const NoiseModel model = fit_noise(variances_of(truth), {}, 255);
  EXPECT_EQ(model.slope_counts, 0.0);
  for (const double counts : {20.0, 44.0, 104.0, 200.0})
    EXPECT_NEAR(std::sqrt(model.variance(counts) / truth(counts)), 1.0, 0.15) << counts;
}

TEST(FitNoise, IsConstantWhereNothingElseIsSure) {
  // A fall of 3 % is within the error of the variances.
  const NoiseModel model =
      fit_noise(variances_of([](double counts) { return 1.0 - 1e-4 * counts; }), {}, 255);
  EXPECT_NEAR(model.floor_counts2, 0.99, 0.01);
  EXPECT_EQ(model.dark_counts2, 0.0);
  EXPECT_EQ(fit_noise({}, {}, 255).floor_counts2, NoiseModel{}.floor_counts2);
}

TEST(FitNoise, TakesWhatDarkPixelsHaveFromThoseThatAreCutOffWhereTheyExceedTheOthers) {
  std::vector<VarianceAt> bright;
  for (double counts = 80.0; counts < 230.0; counts += 12.0)
    bright.push_back({counts, 2.0, kSamples});
  const NoiseModel model = fit_noise(bright, VarianceAt{5.0, 40.0, kSamples}, 255);
  EXPECT_NEAR(model.variance(5.0), 40.0 / 0.341, 1.0);  // half of a Gaussian is at 0
  EXPECT_NEAR(model.variance(150.0), 2.0, 1.0);
  const NoiseModel quiet = fit_noise(bright, VarianceAt{0.5, 0.8, kSamples}, 255);
  EXPECT_EQ(quiet.dark_counts2, 0.0);
}

}  // namespace
}  // namespace frangia::phase
