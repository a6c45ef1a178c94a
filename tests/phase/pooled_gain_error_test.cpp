#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::quarter_steps;
using testing::render_frames;
using testing::Scene;
using testing::tilted_plane;

constexpr double kFrameNoise_counts = 300.0;
const NoiseModel kFrameNoise{.floor_counts2 = kFrameNoise_counts * kFrameNoise_counts};

/// Frames of one view, from a shifter with this gain error and random errors of each shift.
FrameStack jittered(double gain_error, double jitter_deg, std::mt19937& generator) {
  std::normal_distribution<double> error(0.0, rad_from_deg(jitter_deg));
  Pattern made = quarter_steps();
  for (double& shift : made.shifts_rad)
    shift = shift * (1.0 + gain_error) + error(generator);
  const Scene scene{.width = 350,
                    .height = 20,
                    .noise_counts = kFrameNoise_counts,
                    .seed = static_cast<std::uint32_t>(generator())};
  FrameStack stack = render_frames(scene, made, tilted_plane);
  stack.pattern = quarter_steps();
  return stack;
}

/// The constant phase error of a view when this gain error is assumed.
double constant_of(const FrameStack& stack, double gain_error) {
  const FittedAlgorithm fitted = fit_algorithm("schwider", stack, kFrameNoise, {}, gain_error);
  const WrappedPhase map = wrap_phase(stack, fitted.algorithm, kFrameNoise);
  double sum = 0.0;
  for (int x = 0; x < 350; ++x)
    sum += wrap_rad(map.phase_rad(x, 7) - tilted_plane(x, 7)) / 350.0;
  return sum;
}

/// RMS constant phase error of the views of several scans: with the nominal steps, and as decoded.
struct Constants {
  double nominal_rad = 0.0;
  double pooled_rad = 0.0;
};
Constants constants_of(double gain_error, double jitter_deg, int views) {
  const int scans = 64 / views;
  std::mt19937 generator(5);
  Constants out;
  for (int scan = 0; scan < scans; ++scan) {
    std::vector<FrameStack> stacks;
    std::vector<StepEstimate> steps;
    for (int view = 0; view < views; ++view) {
      stacks.push_back(jittered(gain_error, jitter_deg, generator));
      steps.push_back(estimate_step(stacks.back()));
    }
    for (const FrameStack& stack : stacks) {
      out.nominal_rad += std::pow(constant_of(stack, 0.0), 2) / (scans * views);
      out.pooled_rad += std::pow(constant_of(stack, pooled_gain_error(steps)), 2) / (scans * views);
    }
  }
  return {std::sqrt(out.nominal_rad), std::sqrt(out.pooled_rad)};
}

TEST(PooledGainError, IsNoWorseThanTheNominalStepsUnderJitter) {
  const Constants found = constants_of(0.0, 2.0, 8);
  EXPECT_NEAR(found.nominal_rad, 0.0195, 0.004);  // half of the jitter
  EXPECT_LT(found.pooled_rad, 1.02 * found.nominal_rad);
}

TEST(PooledGainError, CorrectsATrueGainErrorUnderJitter) {
  EXPECT_LT(constants_of(0.05, 0.0, 8).pooled_rad, 0.001);
  const Constants both = constants_of(0.05, 2.0, 8);
  EXPECT_GT(both.nominal_rad, 0.11);
  EXPECT_LT(both.pooled_rad, 0.026);
}

TEST(PooledGainError, TrustsASingleViewUnlessItsStepsAreUneven) {
  EXPECT_LT(constants_of(0.05, 0.0, 1).pooled_rad, 0.0015);
  const Constants uneven = constants_of(0.0, 2.0, 1);
  EXPECT_LT(uneven.pooled_rad, 1.3 * uneven.nominal_rad);
}

TEST(PooledGainError, IsZeroWithoutAStep) {
  EXPECT_EQ(pooled_gain_error({}), 0.0);
  const StepEstimate none{.nominal_rad = 1.5, .step_rad = 1.6};
  EXPECT_EQ(pooled_gain_error({&none, 1}), 0.0);
  StepEstimate exact{.nominal_rad = 1.5, .step_rad = 1.5};
  exact.found = true;
  EXPECT_EQ(pooled_gain_error({&exact, 1}), 0.0);
}

TEST(EstimateStep, MeasuresTheJitterOfTheSteps) {
  std::mt19937 generator(3);
  double square = 0.0;
  constexpr int kViews = 60;
  for (int view = 0; view < kViews; ++view)
    square += std::pow(estimate_step(jittered(0.0, 2.0, generator)).jitter_rad, 2) / kViews;
  EXPECT_NEAR(deg_from_rad(std::sqrt(square)), 2.0, 0.5);
  EXPECT_EQ(estimate_step(jittered(0.05, 0.0, generator)).jitter_rad, 0.0);
}

}  // namespace
}  // namespace frangia
