#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/phase/blur/correct_pixel_area.h"

namespace frangia {
namespace {

constexpr int kAreaSide = 120;
constexpr PixelBox kWholeArea{0, 0, kAreaSide, kAreaSide};
constexpr float kAreaNoise = 0.001F;  // rad

using Field = std::function<double(double, double)>;

/// What pixels with an area see of a surface, and the phase at their centers.
struct SeenByPixels {
  AbsolutePhase phase;
  Image<float> modulation{kAreaSide, kAreaSide, 0.0F};
  Image<float> true_rad{kAreaSide, kAreaSide, kMissing};
};

/// Averages the light over 16 x 16 places of each pixel. Pixels without any light have no phase.
SeenByPixels seen(const Field& phase_of, const Field& light_of) {
  constexpr int kPlaces = 16;
  SeenByPixels out;
  out.phase.phase_rad = Image<float>(kAreaSide, kAreaSide, kMissing);
  out.phase.sigma_rad = Image<float>(kAreaSide, kAreaSide, kMissing);
  out.phase.status = Image<PixelStatus>(kAreaSide, kAreaSide, PixelStatus::Unmodulated);
  for (int y = 0; y < kAreaSide; ++y) {
    for (int x = 0; x < kAreaSide; ++x) {
      const double center = phase_of(x, y);
      std::complex<double> sum = 0.0;
      for (int i = 0; i < kPlaces * kPlaces; ++i) {
        const double u = x + (i % kPlaces + 0.5) / kPlaces - 0.5;
        const double v = y + (i / kPlaces + 0.5) / kPlaces - 0.5;
        const double light = light_of(u, v);
        if (light > 0.0) sum += std::polar(light, phase_of(u, v) - center);
      }
      if (!(std::abs(sum) > 0.0)) continue;
      out.true_rad(x, y) = static_cast<float>(center);
      out.phase.phase_rad(x, y) = static_cast<float>(center + std::arg(sum));
      out.phase.sigma_rad(x, y) = kAreaNoise;
      out.phase.status(x, y) = PixelStatus::Measured;
      out.modulation(x, y) = static_cast<float>(100.0 * std::abs(sum) / (kPlaces * kPlaces));
    }
  }
  return out;
}

/// Root mean square of what the phase of some pixels is off.
double error_of(const SeenByPixels& seen, const std::function<bool(int, int)>& counts) {
  double squares = 0.0;
  int count = 0;
  for (int y = 0; y < kAreaSide; ++y) {
    for (int x = 0; x < kAreaSide; ++x) {
      if (!counts(x, y) || std::isnan(seen.phase.phase_rad(x, y))) continue;
      squares += std::pow(seen.phase.phase_rad(x, y) - seen.true_rad(x, y), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 0);
  return std::sqrt(squares / std::max(1, count));
}

/// A ball of 50 pixels in the middle, by fringes that cross it aslant.
double depth_of_ball(double x, double y) {
  const double square = 50.0 * 50.0 - std::pow(x - 60.0, 2) - std::pow(y - 60.0, 2);
  return std::sqrt(std::max(0.0, square));
}
double phase_on_ball(double x, double y) {
  return 0.4 * x + 0.3 * depth_of_ball(x, y);
}
/// As it reflects the light that comes from beside the camera.
double light_on_ball(double x, double y) {
  const double up = depth_of_ball(x, y) / 50.0;
  return up > 0.0 ? std::max(0.0, 0.9 * up + 0.4 * (x - 60.0) / 50.0) : 0.0;
}
double from_middle(int x, int y) {
  return std::hypot(x - 60.0, y - 60.0);
}

TEST(CorrectPixelArea, LeavesATenthOfTheErrorOnABall) {
  SeenByPixels ball = seen(phase_on_ball, light_on_ball);
  const auto inner = [](int x, int y) { return from_middle(x, y) < 40.0 && x > 30; };
  const double before = error_of(ball, inner);
  ASSERT_GT(before, 0.0005);
  correct_pixel_area(ball.phase, ball.modulation, kWholeArea);
  EXPECT_LT(error_of(ball, inner), 0.1 * before);
}

TEST(CorrectPixelArea, CountsWhatMayBeLeft) {
  SeenByPixels ball = seen(phase_on_ball, light_on_ball);
  ball.phase.systematic_rad = Image<float>(kAreaSide, kAreaSide, 0.0F);
  const SeenByPixels before = ball;
  correct_pixel_area(ball.phase, ball.modulation, kWholeArea);
  for (int x = 35; x < 85; ++x) {
    const float error = before.phase.phase_rad(x, 70) - ball.phase.phase_rad(x, 70);
    EXPECT_NEAR(ball.phase.systematic_rad(x, 70), 0.3F * std::abs(error), 1e-5F) << x;
  }
}

TEST(CorrectPixelArea, AddsNoSystematicPartWhereNoneIsKnown) {
  SeenByPixels ball = seen(phase_on_ball, light_on_ball);
  correct_pixel_area(ball.phase, ball.modulation, kWholeArea);
  EXPECT_TRUE(ball.phase.systematic_rad.empty());
}

TEST(CorrectPixelArea, TakesTheVarianceThatIsGiven) {
  SeenByPixels half = seen(phase_on_ball, light_on_ball);
  SeenByPixels whole = half;
  const float before = half.phase.phase_rad(70, 70);
  correct_pixel_area(half.phase, half.modulation, kWholeArea, 0.5 * kPixelAreaVariance);
  correct_pixel_area(whole.phase, whole.modulation, kWholeArea);
  EXPECT_NEAR(half.phase.phase_rad(70, 70) - before,
              0.5F * (whole.phase.phase_rad(70, 70) - before),
              2e-5F);
}

TEST(CorrectPixelArea, AddsItsPartToOneThatIsKnown) {
  SeenByPixels ball = seen(phase_on_ball, light_on_ball);
  ball.phase.systematic_rad = Image<float>(kAreaSide, kAreaSide, 0.01F);
  correct_pixel_area(ball.phase, ball.modulation, kWholeArea);
  EXPECT_GE(ball.phase.systematic_rad(70, 70), 0.01F);
  EXPECT_LT(ball.phase.systematic_rad(70, 70), 0.011F);
}

TEST(CorrectPixelArea, ChangesNothingBesideABorderOfBrightness) {
  // The border lies between two columns: no pixel has light of both sides.
  const auto painted = [](double x, double) { return x < 60.5 ? 0.85 : 0.1; };
  SeenByPixels plane = seen([](double x, double) { return 0.5 * x; }, painted);
  correct_pixel_area(plane.phase, plane.modulation, kWholeArea);
  EXPECT_LT(error_of(plane, [](int, int) { return true; }), 1e-5);
}

TEST(CorrectPixelArea, CorrectsThePixelsThatABorderOfBrightnessCrosses) {
  const auto painted = [](double x, double) { return x < 60.0 ? 0.85 : 0.1; };
  SeenByPixels plane = seen([](double x, double) { return 0.5 * x; }, painted);
  const auto crossed = [](int x, int) { return x == 60; };
  const double before = error_of(plane, crossed);
  ASSERT_GT(before, 0.05);
  correct_pixel_area(plane.phase, plane.modulation, kWholeArea);
  EXPECT_LT(error_of(plane, crossed), 0.75 * before);
}

TEST(CorrectPixelArea, ChangesNothingBesideACrease) {
  const auto bent = [](double x, double) { return x < 60.5 ? 0.2 * x : 12.1 + 0.7 * (x - 60.5); };
  SeenByPixels edge = seen(bent, [](double, double) { return 0.8; });
  correct_pixel_area(edge.phase, edge.modulation, kWholeArea);
  EXPECT_LT(error_of(edge, [](int, int) { return true; }), 1e-5);
}

TEST(CorrectPixelArea, TakesNoNeighbourFromAnotherSurface) {
  const auto step = [](double x, double) { return x < 60.5 ? 0.4 * x : 0.4 * x + 5.0; };
  SeenByPixels steps = seen(step, [](double, double) { return 0.8; });
  correct_pixel_area(steps.phase, steps.modulation, kWholeArea);
  EXPECT_LT(error_of(steps, [](int, int) { return true; }), 1e-5);
}

TEST(CorrectPixelArea, KeepsPixelsBesideMissingOnes) {
  SeenByPixels ball = seen(phase_on_ball, light_on_ball);
  ball.phase.phase_rad(70, 70) = kMissing;
  const Image<float> before = ball.phase.phase_rad;
  correct_pixel_area(ball.phase, ball.modulation, kWholeArea);
  EXPECT_EQ(ball.phase.phase_rad(72, 68), before(72, 68));
  EXPECT_NE(ball.phase.phase_rad(73, 70), before(73, 70));
}

TEST(CorrectPixelArea, AddsHardlyAnyNoise) {
  SeenByPixels plane = seen([](double x, double y) { return 0.5 * x + 0.1 * y; },
                            [](double, double) { return 0.8; });
  std::mt19937 random(1);
  constexpr double kNoise = 0.02;
  std::normal_distribution<double> noise(0.0, kNoise);
  for (std::size_t i = 0; i < plane.phase.phase_rad.pixels().size(); ++i) {
    plane.phase.phase_rad.pixels()[i] += static_cast<float>(noise(random));
    plane.phase.sigma_rad.pixels()[i] = static_cast<float>(kNoise);
    plane.modulation.pixels()[i] *= 1.0F + static_cast<float>(noise(random));
  }
  const auto all = [](int, int) { return true; };
  const double before = error_of(plane, all);
  correct_pixel_area(plane.phase, plane.modulation, kWholeArea);
  EXPECT_LT(error_of(plane, all), 1.01 * before);
}

TEST(CorrectPixelArea, WorksInABox) {
  SeenByPixels whole = seen(phase_on_ball, light_on_ball);
  SeenByPixels part = whole;
  const PixelBox box{50, 40, 90, 80};
  Image<float> modulation(box.width(), box.height());
  for (int y = 0; y < box.height(); ++y) {
    for (int x = 0; x < box.width(); ++x)
      modulation(x, y) = whole.modulation(box.left + x, box.top + y);
  }
  correct_pixel_area(whole.phase, whole.modulation, kWholeArea);
  correct_pixel_area(part.phase, modulation, box);
  EXPECT_EQ(part.phase.phase_rad(70, 60), whole.phase.phase_rad(70, 60));
  EXPECT_NE(part.phase.phase_rad(40, 60), whole.phase.phase_rad(40, 60));
}

}  // namespace
}  // namespace frangia
