#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/pattern/fringe_sequence.h"

namespace frangia {
namespace {

TEST(NarrowBand, HoldsOnlyFineFringesThatDetermineTheOrder) {
  const SequencePlan plan = plan_narrow_band(128, 4, 0.05);
  ASSERT_EQ(plan.fringes.size(), 4U);
  EXPECT_EQ(plan.fringes.back(), 128.0);
  EXPECT_GT(plan.fringes.front(), 0.75 * 128.0);
  EXPECT_LT(plan.wrong_order, 1e-6);
  EXPECT_NEAR(confusion_probability(plan.fringes, 0.05), plan.wrong_order, 1e-12);
}

TEST(NarrowBand, TakesTheBandThatJustHoldsItsMaps) {
  EXPECT_EQ(plan_narrow_band(50, 3, 0.01).fringes, (std::vector<double>{48.0, 49.0, 50.0}));
}

TEST(NarrowBand, WidensWithTheNoise) {
  const double fine = plan_narrow_band(128, 4, 0.02).fringes.front();
  const double noisy = plan_narrow_band(128, 4, 0.1).fringes.front();
  EXPECT_GT(fine, noisy);
}

TEST(NarrowBand, KeepsWrongOrdersBelowTheStatedProbability) {
  // The most likely order by brute force, at a noise that makes errors frequent enough to count.
  const SequencePlan plan = plan_narrow_band(64, 3, 0.08, 1e-2);
  constexpr int kDraws = 20'000;
  int wrong = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const double at = uniform_from(hash(1, draw));
    std::vector<double> phases;
    for (std::size_t m = 0; m < plan.fringes.size(); ++m)
      phases.push_back(kTwoPi * plan.fringes[m] * at + 0.08 * normal_from(hash(m + 2, draw)));
    const double finest = plan.fringes.back();
    double least = 1e9;
    double best = 0.0;
    for (double order = -1.0; order <= finest; order += 1.0) {
      const double absolute = wrap_rad(phases.back()) + kTwoPi * order;
      if (absolute < -0.5 || absolute > kTwoPi * finest + 0.5) continue;
      double square = 0.0;
      double along = 0.0;
      double weights = 0.0;
      for (std::size_t m = 0; m < phases.size(); ++m) {
        const double ratio = plan.fringes[m] / finest;
        const double away = wrap_rad(phases[m] - ratio * absolute);
        square += away * away;
        along += ratio * away;
        weights += ratio * ratio;
      }
      square -= along * along / weights;
      if (square < least) {
        least = square;
        best = absolute;
      }
    }
    if (std::abs(best - kTwoPi * finest * at) > kPi) ++wrong;
  }
  EXPECT_LT(wrong, 1.3 * plan.wrong_order * kDraws + 10.0);
}

TEST(NarrowBand, RejectsWhatNoBandSuffices) {
  EXPECT_THROW(static_cast<void>(plan_narrow_band(200, 2, 0.2)), Error);
  EXPECT_THROW(static_cast<void>(plan_narrow_band(8, 1, 0.05)), Error);
}

}  // namespace
}  // namespace frangia
