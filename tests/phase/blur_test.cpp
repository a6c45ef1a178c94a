#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/phase/blur/correct_blur.h"
#include "frangia/phase/blur/estimate_blur.h"

namespace frangia {
namespace {

constexpr int kAcrossPx = 480;
constexpr int kDownPx = 96;
constexpr float kBlurNoise = 0.003F;  // of the modulation of a bright pixel

/// A surface that bends: its fringes have slopes of 0.25 to 1.2 rad per pixel.
double phase_at(double x, double y) {
  return 0.25 * x + 0.001 * x * x + 0.1 * y;
}

double bright(double /*x*/, double /*y*/) {
  return 1.0;
}

/// Squares of 12 pixels, painted in 0.1 and 0.85 of the light.
double painted(double x, double y) {
  const auto square = [](double at) { return static_cast<int>(std::floor(at / 12.0)); };
  return (square(x) + square(y)) % 2 == 0 ? 0.85 : 0.1;
}

using Light = double (*)(double, double);

constexpr int kAcross = 4;  // points of light beside each other in a pixel

/// Weights of the points around the center of a pixel, along one axis.
std::vector<double> weights_of(double sigma_px) {
  if (sigma_px == 0.0) return {1.0};
  const int reach = kAcross * static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * std::pow(i / (kAcross * sigma_px), 2)));
    sum += weights.back();
  }
  for (double& weight : weights)
    weight /= sum;
  return weights;
}

/// The map of fringes of `share` of the full phase, as a camera with a normal blur sees it.
WrappedPhase blurred(Light light, double sigma_px, double share, unsigned seed) {
  const std::vector<double> weights = weights_of(sigma_px);
  const auto reach = static_cast<int>(weights.size() / 2);
  const int rows = kAcross * (kDownPx - 1) + 1 + 2 * reach;
  // First along the rows of points, then across them.
  std::vector<std::complex<double>> along(static_cast<std::size_t>(kAcrossPx * rows));
  for (int j = 0; j < rows; ++j) {
    const double y = (j - reach + 0.5) / kAcross;  // beside the borders of the squares
    std::vector<std::complex<double>> points;
    for (int i = -reach; i <= kAcross * (kAcrossPx - 1) + reach; ++i) {
      const double x = (i + 0.5) / kAcross;
      points.push_back(light(x, y) * std::polar(1.0, share * phase_at(x - 0.125, y - 0.125)));
    }
    for (int x = 0; x < kAcrossPx; ++x) {
      std::complex<double>& sum = along[static_cast<std::size_t>(j * kAcrossPx + x)];
      for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] * points[static_cast<std::size_t>(kAcross * x) + i];
    }
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, static_cast<double>(kBlurNoise));
  WrappedPhase map;
  map.pattern.period_px = 20.0 / share;
  for (Image<float>* image : {&map.phase_rad, &map.sigma_rad, &map.modulation_counts})
    *image = Image<float>(kAcrossPx, kDownPx);
  map.status = Image<PixelStatus>(kAcrossPx, kDownPx, PixelStatus::Measured);
  for (int y = 0; y < kDownPx; ++y) {
    for (int x = 0; x < kAcrossPx; ++x) {
      std::complex<double> seen(noise(random), noise(random));
      for (std::size_t j = 0; j < weights.size(); ++j)
        seen += weights[j] * along[(static_cast<std::size_t>(kAcross * y) + j) * kAcrossPx +
                                   static_cast<std::size_t>(x)];
      seen *= 100.0;
      map.phase_rad(x, y) = static_cast<float>(std::arg(seen));
      map.modulation_counts(x, y) = static_cast<float>(std::abs(seen));
      map.sigma_rad(x, y) = 100.0F * kBlurNoise / map.modulation_counts(x, y);
    }
  }
  return map;
}

/// Three rows of every twelve.
WrappedPhase bands_of(const WrappedPhase& map) {
  constexpr int kEvery = 12;
  WrappedPhase out = map;
  const auto some = [](const auto& image) {
    auto bands = image;
    bands = {image.width(), image.height() / kEvery * kBlurBandRows, Uninitialized{}};
    for (int y = 0; y < bands.height(); ++y) {
      for (int x = 0; x < bands.width(); ++x)
        bands(x, y) = image(x, y / kBlurBandRows * kEvery + y % kBlurBandRows);
    }
    return bands;
  };
  out.phase_rad = some(map.phase_rad);
  out.sigma_rad = some(map.sigma_rad);
  out.modulation_counts = some(map.modulation_counts);
  return out;
}

std::optional<ImageBlur> estimated(Light light, double sigma_px, double coarse = 0.125) {
  return estimate_blur(whole_light(bands_of(blurred(light, sigma_px, coarse, 1))),
                       bands_of(blurred(light, sigma_px, 1.0, 2)));
}

TEST(EstimateBlur, FindsTheBlurOfBrightAndOfPaintedSurfaces) {
  for (const double sigma_px : {0.7, 1.2}) {
    for (const Light light : {bright, painted}) {
      const auto blur = estimated(light, sigma_px);
      ASSERT_TRUE(blur) << sigma_px;
      EXPECT_NEAR(blur->sigma_px(), sigma_px, 0.1) << (light == bright ? "bright" : "painted");
      EXPECT_LT(blur->u_px2, 0.2 * blur->variance_px2);
    }
  }
}

double averaged_px2(double sigma_px, double coarse = 0.125) {
  return averaged_variance(whole_light(bands_of(blurred(bright, sigma_px, coarse, 1))),
                           bands_of(blurred(bright, sigma_px, 1.0, 2)));
}

TEST(AveragedVariance, IsThatOfTheAreaOfAPixel) {
  EXPECT_EQ(averaged_px2(std::sqrt(kPixelAreaVariance)), kPixelAreaVariance);
}

TEST(AveragedVariance, IsThatOfTheAreaWhereNothingTells) {
  EXPECT_EQ(averaged_px2(0.0, 0.98), kPixelAreaVariance);
}

TEST(AveragedVariance, IsLessWhereTheFringesAreHardlyWeakened) {
  EXPECT_LT(averaged_px2(0.0), 0.2 * kPixelAreaVariance);
}

TEST(EstimateBlur, FindsTheBlurByAPartThatCoversFewColumns) {
  WrappedPhase fine = blurred(bright, 0.7, 1.0, 2);
  for (int y = 0; y < kDownPx; ++y) {
    for (int x = 0; x < kAcrossPx; ++x)
      if (x < 190 || x >= 290) fine.sigma_rad(x, y) = kMissing;
  }
  const auto blur =
      estimate_blur(whole_light(bands_of(blurred(bright, 0.7, 0.125, 1))), bands_of(fine));
  ASSERT_TRUE(blur);
  EXPECT_NEAR(blur->sigma_px(), 0.7, 0.1);
}

TEST(EstimateBlur, FindsTheBlurByTheStripesOfAGrayCode) {
  Image<std::uint8_t> first(kAcrossPx, kDownPx, 20);
  for (int y = 0; y < kDownPx; ++y) {
    for (int x = 0; x < kAcrossPx / 3; ++x)
      first(x, y) = 220;
  }
  Image<std::uint8_t> inverse = first;
  for (std::uint8_t& counts : inverse.pixels())
    counts = static_cast<std::uint8_t>(240 - counts);
  FrameStack gray{.pattern = {.name = "gray", .kind = PatternKind::Gray, .bits = 1}};
  gray.pattern.inverted = InvertedFrames::After;
  gray.frames = {first, inverse};
  const auto blur = estimate_blur(whole_light(gray), blurred(bright, 0.7, 1.0, 2));
  ASSERT_TRUE(blur);
  EXPECT_NEAR(blur->sigma_px(), 0.7, 0.1);
  gray.white_level = 220;
  EXPECT_TRUE(std::isnan(whole_light(gray).counts(0, 0))) << "saturated";
}

TEST(EstimateBlur, FindsTheBlurByFringesThatDifferLittle) {
  const auto blur = estimated(bright, 0.8, 0.7);
  ASSERT_TRUE(blur);
  EXPECT_NEAR(blur->sigma_px(), 0.8, 0.1);
}

TEST(EstimateBlur, FindsNoneInASharpImageAndWherePatternsAreAlike) {
  EXPECT_FALSE(estimated(bright, 0.0));
  EXPECT_FALSE(estimated(painted, 0.0));
  EXPECT_FALSE(estimated(bright, 0.8, 0.97)) << "fringes too much alike";
}

AbsolutePhase unwrapped(const WrappedPhase& map) {
  AbsolutePhase out{.pattern = map.pattern,
                    .phase_rad = map.phase_rad,
                    .sigma_rad = map.sigma_rad,
                    .status = map.status,
                    .systematic_rad = {}};
  for (int y = 0; y < kDownPx; ++y) {
    for (int x = 0; x < kAcrossPx; ++x) {
      float& phase = out.phase_rad(x, y);
      phase += static_cast<float>(
          kTwoPi * std::round((phase_at(x, y) - static_cast<double>(phase)) / kTwoPi));
    }
  }
  return out;
}

/// Root mean squares of the error away from the border of the image, and over its uncertainty.
struct Errors {
  double rad = 0.0;
  double over_sigma = 0.0;
};

Errors errors_of(const AbsolutePhase& phase) {
  constexpr int kBorder = 6;
  Errors out;
  double count = 0.0;
  for (int y = kBorder; y < kDownPx - kBorder; ++y) {
    for (int x = kBorder; x < kAcrossPx - kBorder; ++x) {
      const double error = static_cast<double>(phase.phase_rad(x, y)) - phase_at(x, y);
      if (std::isnan(error)) continue;
      const float systematic = phase.systematic_rad.empty() ? 0.0F : phase.systematic_rad(x, y);
      const auto sigma = static_cast<double>(std::hypot(phase.sigma_rad(x, y), systematic));
      out.rad += error * error;
      out.over_sigma += error * error / (sigma * sigma);
      ++count;
    }
  }
  return {std::sqrt(out.rad / count), std::sqrt(out.over_sigma / count)};
}

TEST(CorrectBlur, TakesThePhaseToItsNoiseAtBordersOfPaint) {
  for (const double sigma_px : {0.7, 1.0}) {
    const WrappedPhase fine = blurred(painted, sigma_px, 1.0, 2);
    AbsolutePhase phase = unwrapped(fine);
    const Errors before = errors_of(phase);
    const BlurCorrection done = correct_blur(phase,
                                             blurred(painted, sigma_px, 0.125, 1).modulation_counts,
                                             {.variance_px2 = sigma_px * sigma_px, .u_px2 = 0.02});
    const Errors after = errors_of(phase);
    EXPECT_GT(before.over_sigma, 4.0);
    EXPECT_LT(after.rad, 0.4 * before.rad);
    EXPECT_GT(after.over_sigma, 0.7);
    EXPECT_LT(after.over_sigma, 1.5);
    EXPECT_GT(done.rms_rad, 0.05);
  }
}

TEST(CorrectBlur, LeavesAnEvenSurfaceAndMissingPixelsAlone) {
  const WrappedPhase fine = blurred(bright, 0.8, 1.0, 2);
  AbsolutePhase phase = unwrapped(fine);
  phase.phase_rad(40, 40) = kMissing;
  const AbsolutePhase before = phase;
  const BlurCorrection done = correct_blur(phase,
                                           blurred(bright, 0.8, 0.125, 1).modulation_counts,
                                           {.variance_px2 = 0.64, .u_px2 = 0.02});
  EXPECT_LT(done.pixels, static_cast<std::size_t>(kAcrossPx * kDownPx / 1000));
  EXPECT_TRUE(std::isnan(phase.phase_rad(40, 40)));
  EXPECT_TRUE(std::isnan(phase.systematic_rad(40, 40)));
  EXPECT_NEAR(errors_of(before).over_sigma, 1.0, 0.1) << "the blur of an even surface is no error";
}

TEST(CorrectBlur, KeepsToItsSurfaceBesideADeeperOne) {
  AbsolutePhase phase = unwrapped(blurred(painted, 0.8, 1.0, 2));
  AbsolutePhase apart = phase;
  constexpr int kStep = 240;
  for (int y = 0; y < kDownPx; ++y)
    for (int x = kStep; x < kAcrossPx; ++x)
      apart.phase_rad(x, y) += 9.0F;
  const Image<float> modulation = blurred(painted, 0.8, 0.125, 1).modulation_counts;
  const ImageBlur blur{.variance_px2 = 0.64, .u_px2 = 0.02};
  correct_blur(phase, modulation, blur);
  correct_blur(apart, modulation, blur);
  for (int y = 6; y < kDownPx - 6; ++y) {
    for (const int x : {kStep - 1, kStep}) {
      const float step = x < kStep ? 0.0F : 9.0F;
      EXPECT_NEAR(apart.phase_rad(x, y) - step, phase.phase_rad(x, y), 0.15) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace frangia
