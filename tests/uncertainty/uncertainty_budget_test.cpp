#include "frangia/uncertainty/uncertainty_budget.h"

#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

TEST(UncertaintyBudget, NamesEachTermOnceAndFindsIt) {
  std::set<std::string_view> names;
  for (const UncertaintyTermInfo& info : uncertainty_terms()) {
    EXPECT_EQ(info_of(info.term).name, info.name);
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.cause.empty());
  }
  EXPECT_EQ(info_of(UncertaintyTerm::Calibration).correlation, ErrorCorrelation::AllViews);
  EXPECT_EQ(info_of(UncertaintyTerm::CameraNoise).part, UncertaintyPart::Noise);
}

TEST(UncertaintyBudget, CombinesIndependentTermsToTheRootOfTheirSquares) {
  EXPECT_DOUBLE_EQ(root_sum_square(std::vector{3.0, 4.0, 12.0}), 13.0);
  EXPECT_EQ(root_sum_square({}), 0.0);
  EXPECT_FLOAT_EQ(combined_sigma(3.0F, 4.0F), 5.0F);
  EXPECT_DOUBLE_EQ((SigmaParts{0.3, 0.4}).combined(), 0.5);
}

TEST(UncertaintyBudget, StatesTheScatterOfAMeanWhoseObservationsShareAnError) {
  const std::vector<WeightedSigma> observations{
      {{0.2, 0.3}, 25.0}, {{0.1, 0.1}, 100.0}, {{0.4, 0.2}, 6.25}};
  double weights = 0.0;
  for (const WeightedSigma& one : observations)
    weights += one.weight;
  constexpr int kDraws = 40'000;
  double squares = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const double shared = normal_from(hash(1, draw));
    double error = 0.0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      const SigmaParts& sigma = observations[i].sigma;
      error += observations[i].weight / weights *
               (sigma.noise * normal_from(hash(i + 2, draw)) + sigma.systematic * shared);
    }
    squares += error * error;
  }
  const SigmaParts stated = sigma_of_mean(observations);
  EXPECT_NEAR(std::sqrt(squares / kDraws), stated.combined(), 0.02 * stated.combined());
}

TEST(UncertaintyBudget, ShrinksOnlyNoiseWithTheNumberOfObservations) {
  const SigmaParts mean = sigma_of_mean(std::vector<WeightedSigma>(16, {{0.4, 0.3}, 6.25}));
  EXPECT_DOUBLE_EQ(mean.noise, 0.1);
  EXPECT_DOUBLE_EQ(mean.systematic, 0.3);
  EXPECT_TRUE(std::isnan(sigma_of_mean({}).noise));
}

}  // namespace
}  // namespace frangia
