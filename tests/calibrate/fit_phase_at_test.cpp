#include "frangia/calibrate/board/fit_phase_at.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

const Eigen::Vector2d kFitted_px(40.3, 30.8);

/// A quadratic phase about the point.
double quadratic(double x, double y) {
  const double u = x - kFitted_px.x();
  const double v = y - kFitted_px.y();
  return 50.0 + 0.3 * u - 0.1 * v + 0.002 * u * u - 0.003 * u * v + 0.001 * v * v;
}

Image<float> phase_image(double noise_rad) {
  Image<float> image(81, 61);
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 81; ++x) {
      const auto stream = static_cast<std::uint64_t>(81 * y + x);
      image(x, y) = static_cast<float>(quadratic(x, y) + noise_rad * normal_from(hash(3, stream)));
    }
  }
  return image;
}

TEST(FitPhaseAt, IsTheValueAndTheGradientOfAQuadratic) {
  const PhaseAt found = fit_phase_at(phase_image(0.0), Image<float>(81, 61, 0.01F), kFitted_px);
  EXPECT_NEAR(found.phase_rad, 50.0, 1e-4);
  EXPECT_NEAR(found.gradient_rad_per_px.x(), 0.3, 1e-4);
  EXPECT_NEAR(found.gradient_rad_per_px.y(), -0.1, 1e-4);
}

TEST(FitPhaseAt, StatesTheSigmaOfAFitToAllPixelsOfItsWindow) {
  // By Legendre polynomials, the value of a quadratic at the middle of a square has 1 + 2 * 5/4
  // times the variance of a mean. The robust weights add a few percent.
  const double sigma = 0.05;
  const PhaseAt found = fit_phase_at(phase_image(sigma),
                                     Image<float>(81, 61, static_cast<float>(sigma)),
                                     {40.0, 31.0},
                                     {.radius_px = 15});
  EXPECT_NEAR(found.sigma_rad / (sigma * std::sqrt(3.5) / 31.0), 1.0, 0.08);
  double square = 0.0;
  int count = 0;
  const Image<float> noisy = phase_image(sigma);
  for (double x = 8.0; x < 75.0; x += 6.0) {
    for (double y = 8.0; y < 55.0; y += 6.0) {
      const PhaseAt at = fit_phase_at(
          noisy, Image<float>(81, 61, static_cast<float>(sigma)), {x, y}, {.radius_px = 6});
      square += std::pow((at.phase_rad - quadratic(x, y)) / at.sigma_rad, 2);
      ++count;
    }
  }
  EXPECT_NEAR(square / count, 1.0, 0.35);
}

TEST(FitPhaseAt, ScalesSigmaToResidualsAboveTheStatedNoise) {
  const Image<float> noisy = phase_image(0.05);
  const double stated = fit_phase_at(noisy, Image<float>(81, 61, 0.05F), kFitted_px).sigma_rad;
  const double low = fit_phase_at(noisy, Image<float>(81, 61, 0.01F), kFitted_px).sigma_rad;
  const double high = fit_phase_at(noisy, Image<float>(81, 61, 0.2F), kFitted_px).sigma_rad;
  EXPECT_NEAR(low / stated, 1.0, 0.15);
  EXPECT_NEAR(high / stated, 4.0, 0.4);
}

TEST(FitPhaseAt, WeighsPixelsByTheirVariance) {
  Image<float> phase = phase_image(0.0);
  Image<float> sigma(81, 61, 0.01F);
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 81; ++x) {
      if ((x + y) % 2 == 0) continue;
      phase(x, y) += 0.5F;  // half of the pixels are off by a sigma of 0.5 rad
      sigma(x, y) = 0.5F;
    }
  }
  EXPECT_NEAR(fit_phase_at(phase, sigma, kFitted_px).phase_rad, 50.0, 0.002);
}

TEST(FitPhaseAt, NeedsEnoughMeasuredPixels) {
  Image<float> phase(81, 61, kMissing);
  const Image<float> sigma(81, 61, 0.01F);
  const Image<float> full = phase_image(0.0);
  const auto measured = [&](int count) {
    for (int i = 0; i < count; ++i)
      phase(36 + i % 6, 28 + i / 6) = full(36 + i % 6, 28 + i / 6);
    return !std::isnan(fit_phase_at(phase, sigma, kFitted_px).phase_rad);
  };
  EXPECT_FALSE(measured(29));
  EXPECT_TRUE(measured(42));
  EXPECT_TRUE(std::isnan(fit_phase_at(full, Image<float>(81, 61, 0.0F), kFitted_px).phase_rad));
  EXPECT_TRUE(std::isnan(fit_phase_at(full, sigma, {-40.0, 30.0}).phase_rad));
  EXPECT_NEAR(fit_phase_at(full, sigma, {2.0, 1.0}).phase_rad, quadratic(2.0, 1.0), 1e-3)
      << "at the corner of the image";
}

}  // namespace
}  // namespace frangia
