// The published algorithms, written as coefficients, are the truth.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

const std::vector<double> kFiveSteps{0.0, kPi / 2, kPi, 1.5 * kPi, kTwoPi};

std::vector<double> counts_of(double phase, const std::vector<double>& shifts) {
  std::vector<double> counts;
  for (const double shift : shifts)
    counts.push_back(120.0 + 80.0 * std::cos(phase + shift));
  return counts;
}

TEST(LinearAlgorithm, EqualsThePublishedOne) {
  const LinearAlgorithm own =
      linear_algorithm("mine", kFiveSteps, {0, -2, 0, 2, 0}, {1, 0, -2, 0, 1});
  const PhaseAlgorithm published = make_algorithm("hariharan", kFiveSteps);
  EXPECT_NEAR(own.algorithm.noise_gain, published.noise_gain, 1e-9);
  for (double phase = -3.0; phase < 3.1; phase += 0.37) {
    EXPECT_NEAR(phase_of(own.algorithm, counts_of(phase, kFiveSteps)), phase, 1e-9);
  }
}

TEST(LinearAlgorithm, TakesOffFactorAndConstantAngle) {
  const std::vector<double> shifts{0.3, 0.3 + kPi / 2, 0.3 + kPi, 0.3 + 1.5 * kPi};
  const LinearAlgorithm own = linear_algorithm(
      "turned", shifts, {7, 0, -7, 0}, {0, 7, 0, -7});  // sine and cosine exchanged
  for (double phase = -3.0; phase < 3.1; phase += 0.37) {
    EXPECT_NEAR(phase_of(own.algorithm, counts_of(phase, shifts)), phase, 1e-9);
  }
}

TEST(LinearAlgorithm, RefusesWhatMeasuresNoPhase) {
  const std::vector<double> four{0.0, kPi / 2, kPi, 1.5 * kPi};
  const auto fault = [&](const std::vector<double>& up, const std::vector<double>& down) {
    return testing::error_of([&] { static_cast<void>(linear_algorithm("x", four, up, down)); });
  };
  EXPECT_NE(fault({0, 1, 0, -1}, {1, 0, -1, 0}).find("change the sign"), std::string::npos);
  EXPECT_NE(fault({0, -1, 0, 2}, {1, 0, -1, 0}).find("mean intensity"), std::string::npos);
  EXPECT_NE(fault({0, -1, 0, 1}, {2, 0, -2, 0}).find("0.34 rad"), std::string::npos)
      << fault({0, -1, 0, 1}, {2, 0, -2, 0});
  EXPECT_NE(fault({0, -1, 0}, {1, 0, -1, 0}).find("3 coefficients"), std::string::npos);
  EXPECT_NE(fault({0, 0, 0, 0}, {0, 0, 0, 0}).find("do not depend"), std::string::npos);
}

TEST(LinearAlgorithm, FitsFramesUpToWholeTurns) {
  const LinearAlgorithm own =
      linear_algorithm("mine", kFiveSteps, {0, -2, 0, 2, 0}, {1, 0, -2, 0, 1});
  EXPECT_TRUE(fits(own, {0.0, kPi / 2, kPi, 1.5 * kPi, 0.0}));
  EXPECT_FALSE(fits(own, {0.0, kPi / 2, kPi, 1.5 * kPi, 0.1}));
  EXPECT_FALSE(fits(own, {0.0, kPi / 2, kPi, 1.5 * kPi}));
}

TEST(LinearAlgorithm, IsReadFromTheExample) {
  const LinearAlgorithm own = read_algorithm(std::filesystem::path(FRANGIA_SOURCE_DIR) /
                                             "examples" / "algorithms" / "my-algorithm.toml");
  EXPECT_EQ(own.algorithm.name, "my-5-step");
  EXPECT_NEAR(phase_of(own.algorithm, counts_of(1.2, own.shifts_rad)), 1.2, 1e-9);
}

TEST(LinearAlgorithm, NamesTheFileAndTheKey) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "mine.toml";
  std::ofstream(path) << "format = \"frangia-algorithm\"\nversion = 1\nname = \"mine\"\n"
                         "shifts_deg = [0, 90, 180, 270]\nnumerator = [0, -1, 0, 1]\n";
  const std::string fault = testing::error_of([&] { static_cast<void>(read_algorithm(path)); });
  EXPECT_NE(fault.find("mine.toml"), std::string::npos) << fault;
  EXPECT_NE(fault.find("denominator is missing"), std::string::npos) << fault;
}

}  // namespace
}  // namespace frangia
