#include "frangia/fusion/internal/hermite_accumulators.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace frangia {
namespace {

/// Adds a view to the sums of a face.
void add_view(HermiteAccumulator::PlaneSum& face,
              HermiteAccumulators::SystematicSum& sum,
              float weight,
              float common_mm,
              float differing_mm2,
              float lateral_mm2 = 0.0F) {
  face.weight += weight;
  face.weight_squared += weight * weight;
  face.lateral_squared += weight * weight * lateral_mm2;
  ++face.views;
  sum.common += weight * common_mm;
  sum.differing_squared += weight * weight * differing_mm2;
}

TEST(HermiteAccumulators, CombinesTheSystematicPartsOfAWeightedMean) {
  HermiteAccumulators hermite(1, true);
  ASSERT_TRUE(hermite.has_systematic());
  // The mean of d1 and d2 with the weights 1 and 3.
  add_view(hermite[0].first, hermite.systematic_sums(0).first, 1.0F, 0.2F, 0.04F, 0.01F);
  add_view(hermite[0].first, hermite.systematic_sums(0).first, 3.0F, 0.6F, 0.16F, 0.02F);
  const float common = (0.2F + 3.0F * 0.6F) / 4.0F;
  const float differing = (0.04F + 9.0F * 0.16F) / 16.0F;
  const float lateral = (0.01F + 9.0F * 0.02F) / 16.0F;
  EXPECT_NEAR(hermite.systematic_mm(0), std::sqrt(common * common + lateral + differing), 1e-6F);
  EXPECT_NEAR(hermite.differing_variance(0), (0.04F + 9.0F * 0.16F) / 10.0F, 1e-6F);
  // What was found between the views at this place counts there, and not again here.
  hermite[0].common_variance = 0.03F;
  EXPECT_NEAR(
      hermite.systematic_mm(0), std::sqrt(common * common + lateral + differing - 0.03F), 1e-6F);
  hermite[0].common_variance = 1.0F;
  EXPECT_NEAR(hermite.systematic_mm(0), common, 1e-6F);
  hermite[0].common_variance = 0.0F;
  hermite.scale_differing(0.25F);
  EXPECT_NEAR(
      hermite.systematic_mm(0), std::sqrt(common * common + lateral + 0.25F * differing), 1e-6F);
}

TEST(HermiteAccumulators, TakesTheFaceWithTheLargerWeight) {
  HermiteAccumulators hermite(HermiteAccumulators::kChunk + 2, true);
  const std::size_t last = HermiteAccumulators::kChunk + 1;  // in the second vector of second faces
  add_view(hermite[last].first, hermite.systematic_sums(last).first, 1.0F, 0.2F, 0.0F);
  EXPECT_EQ(hermite.secondary(last).views, 0);
  EXPECT_EQ(&hermite.dominant(last), &hermite[last].first);
  EXPECT_NEAR(hermite.systematic_mm(last), 0.2F, 1e-6F);
  HermiteAccumulator::PlaneSum& second = hermite.make_secondary(last);
  add_view(second, hermite.systematic_sums(last).second, 2.0F, 0.5F, 0.0F);
  EXPECT_EQ(&hermite.make_secondary(last), &second) << "a second face is added once";
  EXPECT_EQ(&hermite.dominant(last), &second);
  EXPECT_EQ(&hermite.lesser(last), &hermite[last].first);
  EXPECT_NEAR(hermite.systematic_mm(last), 0.5F, 1e-6F);
  hermite.make_secondary(0).weight = 7.0F;
  EXPECT_EQ(hermite.secondary(last).weight, 2.0F);
  EXPECT_EQ(hermite.secondary(0).weight, 7.0F);
  hermite[last].free_space_weight = 2.9F;
  EXPECT_TRUE(hermite.is_supported(last));
  hermite[last].free_space_weight = 3.1F;
  EXPECT_FALSE(hermite.is_supported(last));
}

TEST(HermiteAccumulators, HaveNoSystematicPartUnlessItIsSummed) {
  const HermiteAccumulators hermite(3);
  EXPECT_FALSE(hermite.has_systematic());
  EXPECT_EQ(hermite.differing_variance(0), 0.0F);
}

TEST(Correlation, IsTheAutocorrelationOfATriangle) {
  constexpr double kHalfWidth_mm = 0.3;
  const auto triangle = [](double x) { return std::max(0.0, 1.0 - std::abs(x) / kHalfWidth_mm); };
  const auto overlap = [&](double distance) {
    double sum = 0.0;
    for (int i = -2000; i <= 2000; ++i)
      sum += triangle(i * 1e-3) * triangle(i * 1e-3 - distance);
    return sum;
  };
  for (const double distance : {0.0, 0.1, 0.25, 0.35, 0.5, 0.58, 0.62, 0.9}) {
    EXPECT_NEAR(correlation(static_cast<float>(distance), static_cast<float>(kHalfWidth_mm)),
                overlap(distance) / overlap(0.0),
                1e-4)
        << distance;
  }
}

}  // namespace
}  // namespace frangia
