#include "frangia/uncertainty/uncertainty_budget.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <string>
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

/// The rows of the table of docs/uncertainty.md.
std::vector<std::string> rows_of_the_page() {
  std::ifstream page(FRANGIA_SOURCE_DIR "/docs/uncertainty.md");
  std::vector<std::string> rows;
  for (std::string line; std::getline(page, line);)
    if (line.rfind("| `", 0) == 0) rows.push_back(line);
  return rows;
}

TEST(UncertaintyBudget, IsTheTableOfItsPage) {
  const std::vector<std::string> rows = rows_of_the_page();
  ASSERT_EQ(rows.size(), uncertainty_terms().size());
  for (const UncertaintyTermInfo& info : uncertainty_terms()) {
    const std::string begins = "| `" + std::string(info.name) + "` | " +
                               (info.part == UncertaintyPart::Noise ? "noise" : "systematic") +
                               " | ";
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const std::string& one) {
      return one.rfind(begins, 0) == 0;
    });
    ASSERT_NE(row, rows.end()) << begins;
    if (info.part == UncertaintyPart::Noise) continue;
    const std::string alike =
        info.correlation == ErrorCorrelation::AllViews ? "all views" : "one view";
    EXPECT_EQ(row->substr(begins.size(), alike.size()), alike) << *row;
  }
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
