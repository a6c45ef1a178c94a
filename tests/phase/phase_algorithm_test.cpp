#include "frangia/phase/algorithm/phase_algorithm.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/published_algorithms.h"

#include "support/linspace.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::quarter_steps;

/// Frames 3 + 2 cos(phi + shift) of one pixel.
std::vector<double> frames_of(double phi, const std::vector<double>& shifts) {
  std::vector<double> counts;
  counts.reserve(shifts.size());
  for (const double shift : shifts)
    counts.push_back(3.0 + 2.0 * std::cos(phi + shift));
  return counts;
}

std::vector<double> scaled(std::vector<double> shifts, double factor, double first = 0.0) {
  for (double& shift : shifts)
    shift = factor * shift + first;
  return shifts;
}

TEST(PhaseAlgorithm, EveryAlgorithmRefersThePhaseToShiftZero) {
  for (const PublishedAlgorithm& published : published_algorithms()) {
    for (const double first : {0.0, 0.4, -2.0}) {
      for (const double direction : {1.0, -1.0}) {
        const auto shifts = scaled(example_shifts(published), direction, first);
        const PhaseAlgorithm algorithm = make_algorithm(published.name, shifts);
        for (const double phi : testing::linspace(17, -3.0, 2.9)) {
          EXPECT_NEAR(wrap_rad(phase_of(algorithm, frames_of(phi, shifts)) - phi), 0.0, 1e-9)
              << published.name << " from " << first;
        }
      }
    }
  }
}

TEST(PhaseAlgorithm, AKnownGainErrorLeavesNoConstantInAnyAlgorithm) {
  // A gain error of 5 % moves the phase of four 90 degree steps by 0.118 rad.
  for (const PublishedAlgorithm& published : published_algorithms()) {
    const auto shifts = example_shifts(published);
    const PhaseAlgorithm algorithm = make_algorithm(published.name, shifts, 0.05);
    double sum = 0.0;
    for (int i = 0; i < 360; ++i) {
      const double phi = rad_from_deg(i + 0.5);
      sum += wrap_rad(phase_of(algorithm, frames_of(phi, scaled(shifts, 1.05))) - phi);
    }
    EXPECT_NEAR(sum / 360.0, 0.0, 5e-4) << published.name;
  }
}

TEST(PhaseAlgorithm, LeastSquaresRecoversThePhaseOfUnequalShifts) {
  const std::vector<double> shifts = {0.0, 1.1, 1.9, 4.0, 5.2};
  for (const double phi : testing::linspace(17, -3.0, 2.9)) {
    EXPECT_NEAR(
        wrap_rad(phase_of(least_squares(shifts), frames_of(phi, shifts)) - phi), 0.0, 1e-12);
  }
}

TEST(PhaseAlgorithm, CarreRecoversThePhaseForAnyStep) {
  const auto shifts = equal_shifts(4, 0.5 * kPi);
  for (const double error : {-0.2, 0.1, 0.3}) {
    const PhaseAlgorithm algorithm = make_algorithm("carre", shifts, error);
    for (const double phi : testing::linspace(17, -3.0, 2.9)) {
      const auto counts = frames_of(phi, scaled(shifts, 1.0 + error));
      EXPECT_NEAR(wrap_rad(phase_of(algorithm, counts) - phi), 0.0, 1e-9);
    }
  }
}

TEST(PhaseAlgorithm, DefaultCompensatesStepsForAnInterferometerAndHarmonicsForADisplay) {
  const auto chosen = [](int frames, double step_rad, bool angular) {
    Pattern pattern = quarter_steps(angular ? 1.0 : 0.0);
    pattern.shifts_rad = equal_shifts(frames, step_rad);
    return default_algorithm(pattern);
  };
  EXPECT_EQ(chosen(4, 0.5 * kPi, true), "schwider");
  EXPECT_EQ(chosen(5, 0.5 * kPi, true), "hariharan");
  EXPECT_EQ(chosen(6, 0.5 * kPi, true), "schmit-creath");
  EXPECT_EQ(chosen(7, 0.5 * kPi, true), "de-groot");
  EXPECT_EQ(chosen(7, kTwoPi / 6.0, true), "larkin-oreb");
  EXPECT_EQ(chosen(6, kTwoPi / 6.0, true), "global-carre");
  EXPECT_EQ(chosen(3, kTwoPi / 3.0, true), "least-squares");
  for (const int frames : {3, 4, 5, 6, 7})
    EXPECT_EQ(chosen(frames, 0.5 * kPi, false), "least-squares");
}

TEST(PhaseAlgorithm, NamesMatchingAlgorithmsForAWrongNumberOfFrames) {
  try {
    static_cast<void>(make_algorithm("de-groot", equal_shifts(4, 0.5 * kPi)));
    FAIL() << "seven frames are needed";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "the algorithm \"de-groot\" takes 7 frames 90 degrees apart, which the 4 shifts "
        "of the pattern do not match; use 4-step, schwider, carre, least-squares, global-carre");
  }
}

TEST(PhaseAlgorithm, RefusesShiftsThatDoNotDetermineThePhase) {
  EXPECT_THROW(static_cast<void>(least_squares({0.0, 1.0})), Error);
  EXPECT_THROW(static_cast<void>(least_squares({0.0, kTwoPi, 2.0 * kTwoPi})), Error);
  EXPECT_THROW(static_cast<void>(least_squares({0.0, kPi, 0.0, kPi})), Error);
  EXPECT_THROW(static_cast<void>(make_algorithm("schwider", {0.0, 1.0, 2.0, 3.0})), Error);
  EXPECT_THROW(static_cast<void>(make_algorithm("magic", equal_shifts(4, 0.5 * kPi))), Error);
  EXPECT_THROW(static_cast<void>(make_algorithm("carre", {0.0, kPi, kTwoPi, 3.0 * kPi})), Error);
  EXPECT_THROW(static_cast<void>(least_squares({0.0, 1.0, std::nan("")})), Error);
}

}  // namespace
}  // namespace frangia
