#include "frangia/phase/wrap/wrap_phase.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/published_algorithms.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::quarter_steps;
using testing::render_frames;
using testing::Scene;

constexpr double kRadPerPixel = 0.05;
double gentle_ramp(int x, int /*y*/) {
  return kRadPerPixel * x;
}

WrappedPhase decode(const FrameStack& stack, double noise_counts = 1.0) {
  return wrap_phase(stack,
                    make_algorithm(default_algorithm(stack.pattern), stack.pattern.shifts_rad),
                    {.floor_counts2 = noise_counts * noise_counts});
}

TEST(WrapPhase, RecoversPhaseModulationAndMeanOfCleanFringes) {
  const Scene scene{.width = 3001};  // not a multiple of the tile size
  const WrappedPhase phase = decode(render_frames(scene, quarter_steps(), gentle_ramp));
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      EXPECT_NEAR(
          wrap_rad(phase.phase_rad(x, y) - gentle_ramp(x, y)), 0.0, 6e-5);  // rounding to counts
      EXPECT_NEAR(phase.modulation_counts(x, y), scene.modulation_counts, 1.0);
      EXPECT_NEAR(phase.mean_counts(x, y), scene.mean_counts, 1.0);
      EXPECT_EQ(phase.status(x, y), PixelStatus::Measured);
    }
  }
}

TEST(WrapPhase, MatchesTheStandardLibrarysArcTangent) {
  // Arbitrary counts, so that the sine and cosine sums cover the circle.
  FrameStack stack{.pattern = quarter_steps(), .frames = {}, .white_level = 65535};
  stack.pattern.fringes_per_degree = 0.0;
  stack.pattern.period_px = 20.0;  // least squares: sine (I4 - I2) / 2, cosine (I1 - I3) / 2
  const int side = 257;
  for (int k = 0; k < 4; ++k) {
    Image<std::uint16_t> image(side, side);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int c = (x - 128) * 117;
        const int s = (y - 128) * 119;
        image(x, y) = static_cast<std::uint16_t>(32768 + (k == 0   ? c
                                                          : k == 2 ? -c
                                                          : k == 3 ? s
                                                                   : -s));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  const WrappedPhase phase = decode(stack);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      const double exact = std::atan2((y - 128) * 119.0, (x - 128) * 117.0);
      EXPECT_NEAR(wrap_rad(phase.phase_rad(x, y) - exact), 0.0, 1e-6) << x << ' ' << y;
    }
  }
}

TEST(WrapPhase, PredictsItsOwnNoise) {
  for (const double fringes_per_degree : {1.0, 0.0}) {
    Pattern pattern = quarter_steps(fringes_per_degree);
    pattern.period_px = fringes_per_degree > 0.0 ? 0.0 : 20.0;
    const Scene scene{.height = 200, .modulation_counts = 8000.0, .noise_counts = 200.0, .seed = 7};
    const WrappedPhase phase =
        decode(render_frames(scene, pattern, gentle_ramp), scene.noise_counts);
    double chi_square = 0.0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double error = wrap_rad(phase.phase_rad(x, y) - gentle_ramp(x, y));
        chi_square += std::pow(error / phase.sigma_rad(x, y), 2);
      }
    }
    EXPECT_NEAR(chi_square / (scene.width * scene.height), 1.0, 0.02);
  }
}

TEST(WrapPhase, MarksPixelsSaturatedInAnyFrame) {
  FrameStack stack = render_frames({}, quarter_steps(), gentle_ramp);
  std::get<Image<std::uint16_t>>(stack.frames[2])(5, 1) = 65535;
  const WrappedPhase phase = decode(stack);
  EXPECT_EQ(phase.status(5, 1), PixelStatus::Saturated);
  EXPECT_TRUE(std::isnan(phase.phase_rad(5, 1)));
  EXPECT_EQ(phase.status(6, 1), PixelStatus::Measured);
}

TEST(WrapPhase, MarksNoiseWithoutFringesAsUnmodulated) {
  const Scene dark{
      .height = 500, .mean_counts = 1000.0, .modulation_counts = 0.0, .noise_counts = 20.0};
  const WrappedPhase phase =
      decode(render_frames(dark, quarter_steps(), gentle_ramp), dark.noise_counts);
  for (const PixelStatus status : phase.status.pixels())
    EXPECT_EQ(status, PixelStatus::Unmodulated);
}

TEST(WrapPhase, RefusesFramesThatDoNotMatchThePattern) {
  FrameStack stack = render_frames({}, quarter_steps(), gentle_ramp);
  stack.frames.pop_back();
  EXPECT_THROW(static_cast<void>(decode(stack)), Error);
  stack.frames.emplace_back(Image<std::uint16_t>(3, 3));
  EXPECT_THROW(static_cast<void>(decode(stack)), Error);
}

}  // namespace
}  // namespace frangia
