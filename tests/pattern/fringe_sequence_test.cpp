#include "frangia/pattern/fringe_sequence.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

using Numbers = std::vector<double>;

TEST(FringeSequence, MatchesThePublishedSequencesForSixtyFourFringes) {
  EXPECT_EQ(fringe_sequence("doubling", 64.0), (Numbers{1, 2, 4, 8, 16, 32, 64}));
  EXPECT_EQ(fringe_sequence("negative-exponential", 64.0), (Numbers{32, 48, 56, 60, 62, 63, 64}));
  EXPECT_EQ(fringe_sequence("heterodyne", 64.0), (Numbers{56, 63, 64}));
}

TEST(FringeSequence, RefusesAnUnknownNameAndNoFringes) {
  EXPECT_THROW(static_cast<void>(fringe_sequence("magic", 64.0)), Error);
  EXPECT_THROW(static_cast<void>(fringe_sequence("doubling", std::nan(""))), Error);
}

TEST(WrongOrderProbability, MatchesSimulatedNoise) {
  // The published limits of sigma for a probability of 1e-6, and rates large enough to count.
  for (const auto& [ratio, sigma] :
       {std::pair{2.0, 0.287}, {4.0, 0.156}, {8.0, 0.080}, {16.0, 0.040}})
    EXPECT_NEAR(std::log10(wrong_order_probability(sigma * std::hypot(1.0, ratio))), -6.0, 0.2)
        << ratio;
  for (const double ratio : {2.0, 4.0, 8.0}) {
    const double sigma = 1.4 / std::hypot(1.0, ratio);
    constexpr int kTrials = 1'000'000;
    int wrong = 0;
    for (std::uint64_t i = 0; i < kTrials; ++i) {
      const double coarse = sigma * normal_from(hash(2 * i + 1));
      const double fine = sigma * normal_from(hash(2 * i + 2));
      wrong += std::abs(ratio * coarse - fine) > kPi ? 1 : 0;
    }
    const double expected = kTrials * wrong_order_probability(1.4);
    EXPECT_NEAR(wrong, expected, 4.0 * std::sqrt(expected)) << ratio;
  }
}

TEST(WrongOrderProbability, IsInvertedByTheSigmaThatReachesIt) {
  for (const double probability : {1e-9, 1e-3, 0.1, 0.9})
    EXPECT_NEAR(
        wrong_order_probability(sigma_for_wrong_order_probability(probability)) / probability,
        1.0,
        1e-6);
}

TEST(PlanSequence, IsTheShortestSequenceWithinTheLimit) {
  const SequencePlan plan = plan_sequence(64.0, 0.1);
  EXPECT_EQ(plan.fringes.size(), 4U);
  EXPECT_NEAR(plan.fringes[1], 4.0, 1e-9);
  EXPECT_LT(plan.wrong_order, 1e-6);
  // One map less is not enough: ratio 8 in two steps.
  EXPECT_GT(2.0 * wrong_order_probability(0.1 * std::sqrt(65.0)), 1e-6);
  EXPECT_EQ(plan_sequence(1.0, 0.1).fringes, Numbers{1.0});
}

TEST(PlanSequence, RefusesMoreFringesThanAnyCameraResolves) {
  EXPECT_THROW(static_cast<void>(plan_sequence(1e300, 0.1)), Error);
  EXPECT_THROW(static_cast<void>(fringe_sequence("doubling", 1e300)), Error);
}

TEST(PlanSequence, RefusesNoiseTooLargeForAnySequence) {
  EXPECT_THROW(static_cast<void>(plan_sequence(64.0, 2.0)), Error);
  EXPECT_THROW(static_cast<void>(plan_sequence(64.0, std::nan(""))), Error);
}

}  // namespace
}  // namespace frangia
