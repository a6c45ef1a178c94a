#include "frangia/phase/internal/best_frequency.h"

#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"

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

}  // namespace
}  // namespace frangia
