#include "frangia/diagnose/score.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

/// Residuals in blocks of `size`, of variance 1, of which `correlation` is common to a block.
double share_of_blocks(int size, double correlation) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  std::vector<double> residuals;
  std::vector<int> blocks;
  for (int block = 0; block < 4000; ++block) {
    const double common = std::sqrt(correlation) * normal(generator);
    for (int i = 0; i < size; ++i) {
      residuals.push_back(common + std::sqrt(1.0 - correlation) * normal(generator));
      blocks.push_back(block);
    }
  }
  return effective_share(residuals, blocks);
}

TEST(EffectiveShare, IsOneForIndependentSamples) {
  EXPECT_NEAR(share_of_blocks(9, 0.0), 1.0, 0.1);  // a correlation of 0.01
}

TEST(EffectiveShare, IsOneSampleForEachBlockOfEqualOnes) {
  EXPECT_NEAR(share_of_blocks(9, 1.0), 1.0 / 9.0, 1e-9);
}

TEST(EffectiveShare, FollowsTheDesignEffectOfKish) {
  EXPECT_NEAR(share_of_blocks(5, 0.3), 1.0 / (1.0 + 4.0 * 0.3), 0.02);
}

TEST(Choose, NamesHypothesesThatPredictTheSameTogether) {
  const std::vector<ScoredHypothesis> scored{{.text = "a", .log_evidence = -10.0, .prediction = 0},
                                             {.text = "b", .log_evidence = -3.0, .prediction = 1},
                                             {.text = "c", .log_evidence = -2.0, .prediction = 1}};
  const Explanation found = choose(scored);
  EXPECT_EQ(found.best, (std::vector<std::string>{"c", "b"}));
  EXPECT_EQ(found.second, std::vector<std::string>{"a"});
  EXPECT_NEAR(found.log_odds, std::log(std::exp(-2.0) + std::exp(-3.0)) + 10.0, 1e-12);
}

TEST(Choose, DecidesFromOddsOfAHundredOn) {
  const auto odds = [](double against) {
    return choose(std::vector<ScoredHypothesis>{
        {.text = "a", .log_evidence = 0.0, .prediction = 0},
        {.text = "b", .log_evidence = -std::log(against), .prediction = 1}});
  };
  EXPECT_FALSE(odds(99.0).is_decided());
  EXPECT_TRUE(odds(101.0).is_decided());
  EXPECT_EQ(describe(odds(350.0)), "a (odds 350 : 1 against: b)");
}

TEST(Prices, AreThatOfSchwarzAndTheNumberOfChoices) {
  EXPECT_DOUBLE_EQ(price_of_parameter(100.0), 0.5 * std::log(100.0));
  EXPECT_DOUBLE_EQ(price_of_choice(12), std::log(12.0));
}

}  // namespace
}  // namespace frangia
