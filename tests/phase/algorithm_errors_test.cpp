#include "frangia/phase/algorithm/algorithm_errors.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/phase/algorithm/published_algorithms.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;

/// A row of the published table, in the published digits.
struct Row {
  const char* name;
  int frames;
  double step_rad;
  const char* ripple;
  const char* gain;
  const char* second;
  const char* third;
};

/// Formats `value` with as many decimals as `printed`.
std::string in_digits_of(const std::string& printed, double value) {
  const std::size_t point = printed.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : printed.size() - point - 1;
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text == "-0" ? "0" : text;
}

TEST(AlgorithmErrors, MatchThePublishedTableToTheLastDigit) {
  const double quarter = 0.5 * kPi;
  const std::vector<Row> table = {{"3-step-120", 3, kTwoPi / 3.0, "0.12", "0.816", "1", "0"},
                                  {"3-step-90", 3, quarter, "0.079", "1.00", "2", "1"},
                                  {"4-step", 4, quarter, "0.0786", "0.707", "0", "1"},
                                  {"schwider", 4, quarter, "0.0031", "0.866", "1.1", "1"},
                                  {"carre", 4, quarter, "0", "0.87", "1", "1"},
                                  {"hariharan", 5, quarter, "0.0031", "0.661", "0", "1"},
                                  {"schmit-creath", 6, quarter, "0.00012", "0.637", "0", "1"},
                                  {"de-groot", 7, quarter, "0.00000", "0.619", "0", "1"},
                                  {"larkin-oreb", 7, kTwoPi / 6.0, "0.0018", "0.56", "0", "0"},
                                  {"least-squares", 6, kTwoPi / 6.0, "0.06", "0.577", "0", "0"}};
  for (const Row& row : table) {
    const auto shifts = equal_shifts(row.frames, row.step_rad);
    const AlgorithmErrors errors = algorithm_errors(make_algorithm(row.name, shifts), shifts);
    EXPECT_EQ(in_digits_of(row.ripple, errors.ripple_rad), row.ripple) << row.name;
    EXPECT_EQ(in_digits_of(row.gain, errors.noise_gain), row.gain) << row.name;
    EXPECT_EQ(in_digits_of(row.second, errors.second_harmonic), row.second) << row.name;
    EXPECT_EQ(in_digits_of(row.third, errors.third_harmonic), row.third) << row.name;
  }
}

TEST(AlgorithmErrors, LeastSquaresReachesTheNoiseLimitForAnyNumberOfFrames) {
  for (int frames = 5; frames <= 16; ++frames) {
    const auto shifts = equal_shifts(frames, kTwoPi / frames);
    const AlgorithmErrors errors =
        algorithm_errors(make_algorithm("least-squares", shifts), shifts);
    EXPECT_NEAR(errors.noise_gain, std::sqrt(2.0 / frames), 1e-6);
    EXPECT_GT(errors.ripple_rad, 0.05) << frames;
    EXPECT_LT(errors.ripple_rad, 0.07) << frames;
    EXPECT_LT(errors.second_harmonic + errors.third_harmonic, 1e-4) << frames;
  }
}

TEST(AlgorithmErrors, AKnownStepLeavesNoRipple) {
  const auto shifts = equal_shifts(4, 0.5 * kPi);
  const PhaseAlgorithm global = make_algorithm("global-carre", shifts);
  EXPECT_LT(algorithm_errors(global, shifts, true).ripple_rad, 1e-9);
  EXPECT_NEAR(algorithm_errors(global, shifts, false).ripple_rad, 0.0786, 1e-4);
}

TEST(AlgorithmErrors, SchwidersRippleStaysBelow0_0035UpToFivePercent) {
  const auto shifts = equal_shifts(4, 0.5 * kPi);
  const PhaseAlgorithm algorithm = make_algorithm("schwider", shifts);
  for (int percent = -5; percent <= 5; ++percent)
    EXPECT_LT(ripple(algorithm, shifts, 0.01 * percent), 0.0035);
}

}  // namespace
}  // namespace frangia
