#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/phase/waveform/fringe_response.h"

#include "support/error_of.h"

namespace frangia {
namespace {

const std::vector<double> kQuarterTurns = {0.0, kPi / 2, kPi, 3 * kPi / 2};

/// The phase that an algorithm measures of fringes with this light.
template <typename Light>
double seen_phase(const Light& light_of, double phase, const std::vector<double>& shifts) {
  std::vector<double> light;
  for (const double shift : shifts)
    light.push_back(light_of(phase + shift));
  return phase_of(least_squares(shifts), light);
}

TEST(ResponseTable, TurnsTheMeasuredPhaseIntoTheProjectedOne) {
  const FringeWaveform waveform{.harmonics = {{0.1, 0.05}, {0.08, -0.03}}};
  const ResponseTable table = response_table(waveform, least_squares(kQuarterTurns), kQuarterTurns);
  EXPECT_EQ(table.correction_rad.size(), 1025U);
  double largest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double phase = -kPi + kTwoPi * (i + 0.37) / 200.0;
    const double seen =
        seen_phase([&](double at) { return waveform.light_at(at); }, phase, kQuarterTurns);
    EXPECT_NEAR(wrap_rad(seen + correction_at(table, seen) - phase), 0.0, 2e-5);
    largest = std::max(largest, std::abs(wrap_rad(seen - phase)));
  }
  EXPECT_GT(largest, 0.05);
}

TEST(ResponseTable, OfAResponseIsThatOfItsCosineFringes) {
  std::vector<double> levels;
  std::vector<double> light;
  for (int k = 0; k <= 16; ++k) {
    levels.push_back(k / 16.0);
    light.push_back(std::pow(k / 16.0, 2.2));
  }
  const ResponseCurve response = make_response_curve(levels, light);
  const std::vector<double> thirds = {0.0, kTwoPi / 3, 2 * kTwoPi / 3};
  const ResponseTable table = response_table(response, least_squares(thirds), thirds);
  for (int i = 0; i < 50; ++i) {
    const double phase = -kPi + kTwoPi * (i + 0.5) / 50.0;
    const double seen = seen_phase(
        [&](double at) { return response.light_of(0.5 + 0.5 * std::cos(at)); }, phase, thirds);
    EXPECT_NEAR(wrap_rad(seen + correction_at(table, seen) - phase), 0.0, 2e-4);
  }
}

TEST(ResponseTable, RefusesAWaveformWhosePhasesMeasureAlike) {
  const FringeWaveform waveform{.harmonics = {{0.0, 0.0}, {1.3, 0.0}}};
  EXPECT_NE(
      testing::error_of([&] {
        static_cast<void>(response_table(waveform, least_squares(kQuarterTurns), kQuarterTurns));
      }).find("too nonlinear"),
      std::string::npos);
}

/// A correction of a sin(phase), as a table.
ResponseTable sine_table(double a) {
  ResponseTable table;
  for (int i = 0; i <= 1024; ++i)
    table.correction_rad.push_back(static_cast<float>(a * std::sin(-kPi + kTwoPi * i / 1024.0)));
  return table;
}

TEST(CorrectionAt, InterpolatesTheTableAndRepeatsEachTurn) {
  const ResponseTable table = sine_table(0.2);
  for (const double phase : {-3.14, -2.0, -0.001, 0.0, 1.0, 3.13, 3.2, -7.0, 20.0})
    EXPECT_NEAR(correction_at(table, phase), 0.2 * std::sin(phase), 5e-6) << phase;
}

TEST(CorrectResponse, CorrectsEachPixelAndScalesItsSigmas) {
  WrappedPhase phase;
  phase.phase_rad = Image<float>(64, 3);
  phase.sigma_rad = Image<float>(64, 3, 0.01F);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 64; ++x)
      phase.phase_rad(x, y) = static_cast<float>(-kPi + kTwoPi * (x + 0.5) / 64.0);
  }
  phase.phase_rad(5, 1) = kMissing;
  const Image<float> seen = phase.phase_rad;
  WrappedPhase with_systematic = phase;
  with_systematic.systematic_rad = Image<float>(64, 3, 0.03F);
  correct_response(sine_table(0.2), phase);
  correct_response(sine_table(0.2), with_systematic);
  EXPECT_TRUE(phase.systematic_rad.empty());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (x == 5 && y == 1) {
        EXPECT_TRUE(std::isnan(phase.phase_rad(x, y)));
        continue;
      }
      const double at = seen(x, y);
      EXPECT_NEAR(phase.phase_rad(x, y), wrap_rad(at + 0.2 * std::sin(at)), 1e-5);
      EXPECT_NEAR(phase.sigma_rad(x, y), 0.01 * (1.0 + 0.2 * std::cos(at)), 2e-5);
      EXPECT_NEAR(with_systematic.systematic_rad(x, y), 0.03 * (1.0 + 0.2 * std::cos(at)), 5e-5);
    }
  }
}

}  // namespace
}  // namespace frangia
