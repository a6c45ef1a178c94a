#include "frangia/phase/phase_algorithm.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::quarter_steps;

/// The phase that an algorithm finds for frames A + B cos(phi + shift), of any waveform.
template <typename Waveform>
double found_phase(const PhaseAlgorithm& algorithm,
                   const std::vector<double>& true_shifts,
                   double phi,
                   const Waveform& waveform) {
  double sine = 0.0;
  double cosine = 0.0;
  for (std::size_t k = 0; k < true_shifts.size(); ++k) {
    const double counts = 3.0 + waveform(phi + true_shifts[k]);
    sine += algorithm.sine[k] * counts;
    cosine += algorithm.cosine[k] * counts;
  }
  return std::atan2(sine, cosine);
}

double cosine_wave(double angle) {
  return 2.0 * std::cos(angle);
}

/// Peak-to-valley phase error over a fringe when every step is `error` too long.
double ripple(const PhaseAlgorithm& algorithm, const std::vector<double>& shifts, double error) {
  std::vector<double> made = shifts;
  for (double& shift : made)
    shift *= 1.0 + error;
  double low = 1e9;
  double high = -1e9;
  for (double phi = -kPi; phi < kPi; phi += 0.001) {
    const double off = wrap_rad(found_phase(algorithm, made, phi, cosine_wave) - phi);
    low = std::min(low, off);
    high = std::max(high, off);
  }
  return high - low;
}

TEST(PhaseAlgorithm, FindsThePhaseForRisingFallingAndLateStartingSteps) {
  for (const double first : {0.0, 0.4, -2.0}) {
    for (const double step : {0.5 * kPi, -0.5 * kPi}) {
      std::vector<double> shifts = equal_shifts(4, step);
      for (double& shift : shifts)
        shift += first;
      for (double phi = -3.0; phi < 3.0; phi += 0.37) {
        EXPECT_NEAR(
            wrap_rad(found_phase(schwider(shifts), shifts, phi, cosine_wave) - phi), 0.0, 1e-12);
        EXPECT_NEAR(wrap_rad(found_phase(least_squares(shifts), shifts, phi, cosine_wave) - phi),
                    0.0,
                    1e-12);
      }
    }
  }
}

TEST(PhaseAlgorithm, LeastSquaresFindsThePhaseOfUnequalShifts) {
  const std::vector<double> shifts = {0.0, 1.1, 1.9, 4.0, 5.2};
  for (double phi = -3.0; phi < 3.0; phi += 0.37)
    EXPECT_NEAR(
        wrap_rad(found_phase(least_squares(shifts), shifts, phi, cosine_wave) - phi), 0.0, 1e-12);
}

TEST(PhaseAlgorithm, SchwiderCompensatesAStepErrorThatThePlainOneDoesNot) {
  const auto shifts = equal_shifts(4, 0.5 * kPi);
  EXPECT_NEAR(ripple(schwider(shifts), shifts, 0.05), 0.0031, 0.0001);
  EXPECT_NEAR(ripple(schwider(shifts), shifts, -0.05), 0.0031, 0.0001);
  EXPECT_NEAR(ripple(least_squares(shifts), shifts, 0.05), 0.0786, 0.0002);
}

TEST(PhaseAlgorithm, NoiseGainIsThePublishedOne) {
  EXPECT_NEAR(schwider(equal_shifts(4, 0.5 * kPi)).noise_gain(), 0.866, 0.001);
  for (const int frames : {3, 4, 6, 9}) {
    const double gain = least_squares(equal_shifts(frames, kTurn / frames)).noise_gain();
    EXPECT_NEAR(gain, std::sqrt(2.0 / frames), 1e-12);
  }
}

TEST(PhaseAlgorithm, SchwiderLetsTheSecondHarmonicInAndThePlainFourFramesKeepItOut) {
  const auto shifts = equal_shifts(4, 0.5 * kPi);
  const auto wave = [](double angle) { return std::cos(angle) + 0.01 * std::cos(2.0 * angle); };
  double worst_schwider = 0.0;
  double worst_plain = 0.0;
  for (double phi = -kPi; phi < kPi; phi += 0.01) {
    worst_schwider = std::max(
        worst_schwider, std::abs(wrap_rad(found_phase(schwider(shifts), shifts, phi, wave) - phi)));
    worst_plain =
        std::max(worst_plain,
                 std::abs(wrap_rad(found_phase(least_squares(shifts), shifts, phi, wave) - phi)));
  }
  EXPECT_NEAR(worst_schwider, 0.011, 0.001);
  EXPECT_LT(worst_plain, 1e-12);
}

TEST(PhaseAlgorithm, AutoIsSchwiderForAnInterferometerAndLeastSquaresForADisplay) {
  EXPECT_EQ(choose_algorithm("auto", quarter_steps()).name, "schwider");
  Pattern display = quarter_steps(0.0);
  display.period_px = 20.0;
  EXPECT_EQ(choose_algorithm("auto", display).name, "least-squares");
  Pattern three = quarter_steps();
  three.shifts_rad = equal_shifts(3, kTurn / 3.0);
  EXPECT_EQ(choose_algorithm("auto", three).name, "least-squares");
}

TEST(PhaseAlgorithm, RefusesShiftsThatDoNotDetermineThePhase) {
  EXPECT_THROW(static_cast<void>(least_squares({0.0, 1.0})), Error);
  EXPECT_THROW(static_cast<void>(least_squares({0.0, kTurn, 2.0 * kTurn})), Error);
  EXPECT_THROW(static_cast<void>(least_squares({0.0, kPi, 0.0, kPi})), Error);
  EXPECT_THROW(static_cast<void>(schwider({0.0, 1.0, 2.0, 3.0})), Error);
  EXPECT_THROW(static_cast<void>(choose_algorithm("magic", quarter_steps())), Error);
}

}  // namespace
}  // namespace frangia
