#include "frangia/simulate/internal/speckle.h"

#include <cmath>

#include <gtest/gtest.h>

namespace frangia {
namespace {

struct Moments {
  double mean = 0.0, contrast = 0.0, neighbour = 0.0;
};

Moments moments_of(const Image<Speckle>& speckle) {
  double sum = 0.0;
  double sum2 = 0.0;
  double sum_next = 0.0;
  const double count = static_cast<double>((speckle.width() - 1) * speckle.height());
  for (int y = 0; y < speckle.height(); ++y) {
    for (int x = 0; x + 1 < speckle.width(); ++x) {
      const auto here = static_cast<double>(speckle(x, y).gain);
      sum += here;
      sum2 += here * here;
      sum_next += here * static_cast<double>(speckle(x + 1, y).gain);
    }
  }
  const double mean = sum / count;
  const double variance = sum2 / count - mean * mean;
  return {mean, std::sqrt(variance) / mean, (sum_next / count - mean * mean) / variance};
}

TEST(Speckle, HasTheContrastAndTheGrainAskedFor) {
  for (const double contrast : {0.2, 1.0}) {
    const auto m = moments_of(speckle_of(400, 300, 1, {contrast, 2.3548, 1.0}));
    EXPECT_NEAR(m.mean, 1.0, 0.02);
    EXPECT_NEAR(m.contrast, contrast, 0.02 * contrast + 0.01);
    EXPECT_NEAR(m.neighbour, std::exp(-0.5), 0.03);  // sigma of 1 px
  }
}

TEST(Speckle, OfEqualBeamsDoesNotMoveThePhase) {
  const auto speckle = speckle_of(100, 100, 1, {0.5, 1.5, 1.0});
  for (const Speckle& here : speckle.pixels())
    EXPECT_NEAR(std::arg(here.fringe), 0.0F, 1e-4F);
}

TEST(Speckle, OfBeamsThatDifferMovesThePhaseTheMoreTheyDo) {
  const auto phase_rms = [](double correlation) {
    const auto speckle = speckle_of(300, 300, 1, {0.3, 1.5, correlation});
    double sum2 = 0.0;
    for (const Speckle& here : speckle.pixels())
      sum2 += std::pow(static_cast<double>(std::arg(here.fringe)), 2);
    return std::sqrt(sum2 / (300.0 * 300.0));
  };
  // The experience is 0.65 to 0.9 times C * sqrt(1 - mu^2).
  EXPECT_NEAR(phase_rms(0.95), 0.78 * 0.3 * std::sqrt(1.0 - 0.95 * 0.95), 0.02);
  EXPECT_GT(phase_rms(0.8), 1.5 * phase_rms(0.95));
}

}  // namespace
}  // namespace frangia
