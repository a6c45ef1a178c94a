#include "frangia/phase/temporal/internal/phase_ripple.h"

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// The ripple that is found in errors of a phase, with noise of 0.3 rad.
double found_in(const std::function<double(double)>& error_rad, int pixels = 3000) {
  std::mt19937 generator(2);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<float> phases;
  std::vector<double> errors;
  for (int i = 0; i < pixels; ++i) {
    const double phase = wrap_rad(0.37 * i);
    phases.push_back(static_cast<float>(phase));
    errors.push_back(wrap_rad(2.0 + error_rad(phase) + noise(generator)));
  }
  return phase_ripple(phases, errors);
}

TEST(PhaseRipple, IsTheRmsOfWhatRepeatsWithOnceAndTwiceThePhase) {
  const double found = found_in(
      [](double phase) { return 0.2 * std::sin(phase + 1.0) + 0.1 * std::cos(2.0 * phase); });
  EXPECT_NEAR(found, std::sqrt(0.5 * (0.2 * 0.2 + 0.1 * 0.1)), 0.02);
}

TEST(PhaseRipple, IsNothingForNoiseAStartOrTheRippleOfHarmonicsInThreeFrames) {
  EXPECT_EQ(found_in([](double) { return 0.0; }), 0.0);
  EXPECT_EQ(found_in([](double phase) { return 0.2 * std::sin(3.0 * phase); }), 0.0);
  EXPECT_EQ(found_in([](double phase) { return 0.2 * std::sin(phase); }, 100), 0.0);
}

}  // namespace
}  // namespace frangia
