#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/phase/internal/fringe_frequency.h"

namespace frangia {
namespace {

constexpr double kField = 640.0;
constexpr double kDeclared = 1.0 / 40.0;

/// Phases of this frequency at random places, of which a share is unrelated.
double found_frequency(double frequency, double unrelated) {
  std::vector<double> places;
  std::vector<float> phases;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    places.push_back(kField * uniform_from(hash(1, i)));
    const bool wrong = uniform_from(hash(2, i)) < unrelated;
    phases.push_back(static_cast<float>(
        wrap_rad(kTwoPi * (wrong ? uniform_from(hash(3, i)) : frequency * places.back()))));
  }
  return best_frequency(places, phases, kDeclared, kField);
}

TEST(BestFrequency, FindsTheFrequencyUpToFourTimesTheDeclaredOne) {
  for (const double factor : {0.1, 0.5, 1.0, 1.37, 3.9})
    EXPECT_NEAR(found_frequency(factor * kDeclared, 0.0), factor * kDeclared, 1e-6) << factor;
  EXPECT_EQ(found_frequency(4.2 * kDeclared, 0.0), 0.0);
}

TEST(BestFrequency, NeedsHalfOfThePhasesToAgree) {
  EXPECT_NEAR(found_frequency(kDeclared, 0.4), kDeclared, 1e-5);
  EXPECT_EQ(found_frequency(kDeclared, 0.6), 0.0);
  EXPECT_EQ(found_frequency(kDeclared, 1.0), 0.0);
}

/// Odds of fringes of 300 px against the declared 40 px at borders every 20 px, 100 pixels each.
/// The borders are displaced by up to `error_rad`, all pixels of one alike.
double odds_at_borders(double frequency, double error_rad) {
  std::vector<double> places;
  std::vector<float> phases;
  for (std::uint64_t border = 1; border < 31; ++border) {
    const double error = error_rad * (2.0 * uniform_from(hash(4, border)) - 1.0);
    for (std::uint64_t i = 0; i < 100; ++i) {
      const double noise = 0.1 * (uniform_from(hash(border, i)) - 0.5);
      places.push_back(20.0 * static_cast<double>(border));
      phases.push_back(
          static_cast<float>(wrap_rad(kTwoPi * frequency * places.back() + error + noise)));
    }
  }
  return log_odds_of_frequency(places, phases, 1.0 / 300.0, kDeclared, 300.0);
}

TEST(LogOddsOfFrequency, AreHighForFringesOfAnotherPeriod) {
  EXPECT_GT(odds_at_borders(1.0 / 300.0, 0.5), std::log(100.0));
}

TEST(LogOddsOfFrequency, AreLowForTheDeclaredPeriodHoweverTheBordersScatter) {
  for (const double error_rad : {0.0, 1.0, 1.8, 2.5, 3.1})
    EXPECT_LT(odds_at_borders(kDeclared, error_rad), std::log(100.0)) << error_rad;
}

}  // namespace
}  // namespace frangia
