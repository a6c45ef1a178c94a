#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/fringe_sequence.h"

namespace frangia {
namespace {

TEST(OrderConfusion, KnowsWhichCombinationsAreUnique) {
  EXPECT_TRUE(determines_order(std::vector<double>{1.0}));
  EXPECT_TRUE(determines_order(std::vector<double>{1.0, 8.0, 64.0}));
  EXPECT_TRUE(determines_order(std::vector<double>{53.0, 58.0, 64.0}));
  EXPECT_FALSE(determines_order(std::vector<double>{64.0}));
  EXPECT_FALSE(determines_order(std::vector<double>{10.0, 20.0}));
  EXPECT_FALSE(determines_order(std::vector<double>{52.0, 58.0, 64.0}));  // all even: two halves
}

TEST(OrderConfusion, OfTwoMapsIsThatOfComparingThem) {
  // One fringe unwraps eight: wrong where the noise of the scaled phase exceeds pi.
  const double sigma = 0.15;
  const double compared = std::erfc(kPi / (sigma * std::sqrt(65.0) * std::sqrt(2.0)));
  EXPECT_NEAR(
      confusion_probability(std::vector<double>{1.0, 8.0}, sigma), compared, 0.01 * compared);
}

TEST(OrderConfusion, PlansASafeSequenceWithoutCoarseFringes) {
  const SequencePlan plan = plan_beats(64.0, 3, 32.0, 0.05);
  ASSERT_EQ(plan.fringes.size(), 3U);
  EXPECT_EQ(plan.fringes.back(), 64.0);
  EXPECT_GE(plan.fringes.front(), 32.0);
  EXPECT_LE(plan.wrong_order, confusion_probability(std::vector<double>{53.0, 58.0, 64.0}, 0.05));
}

TEST(OrderConfusion, PlansTheTwoMapsOfLeastConfusion) {
  constexpr double kSigma_rad = 0.2;
  const SequencePlan plan = plan_beats(16.0, 2, 1.0, kSigma_rad, 1.0);
  for (double count = 1.0; count < 16.0; count += 1.0)
    EXPECT_GE(confusion_probability(std::vector<double>{count, 16.0}, kSigma_rad), plan.wrong_order)
        << count;
}

TEST(OrderConfusion, PlansMapsOfWhichNoOtherCountIsBetter) {
  constexpr double kSigma_rad = 0.2;
  const SequencePlan plan = plan_beats(24.0, 4, 8.0, kSigma_rad, 1.0);
  for (const std::size_t map : {0U, 1U, 2U}) {
    for (double count = 8.0; count < 24.0; count += 1.0) {
      std::vector<double> changed = plan.fringes;
      changed[map] = count;
      EXPECT_GE(confusion_probability(changed, kSigma_rad), plan.wrong_order * (1.0 - 1e-9))
          << map << " " << count;
    }
  }
}

TEST(OrderConfusion, RefusesWhatCannotBePlanned) {
  EXPECT_THROW(static_cast<void>(plan_beats(64.0, 1, 32.0, 0.05)), Error);
  EXPECT_THROW(static_cast<void>(plan_beats(64.0, 2, 64.0, 0.05)), Error);
  EXPECT_THROW(static_cast<void>(plan_beats(1e300, 3, 32.0, 0.05)), Error);
  EXPECT_THROW(static_cast<void>(plan_beats(64.0, 2, 60.0, 0.3)), Error);
  EXPECT_THROW(static_cast<void>(plan_beats(64.0, 3, 32.0, std::nan(""))), Error);
  EXPECT_THROW(static_cast<void>(confusion_probability({}, 0.1)), Error);
  EXPECT_THROW(static_cast<void>(confusion_probability(std::vector<double>{1e300}, 0.1)), Error);
}

}  // namespace
}  // namespace frangia
