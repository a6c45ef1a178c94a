#include "frangia/phase/assess_frames.h"

#include <cmath>
#include <ctime>
#include <limits>

#include <gtest/gtest.h>

#include "frangia/phase/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::equal_shifts;
using testing::render_frames;
using testing::Scene;
using testing::tilted_plane;

const NoiseModel kAssessedNoise{.floor_counts2 = 200.0 * 200.0};

struct AssessedFringes {
  FrameStack stack;
  FittedAlgorithm fitted;
  WrappedPhase map;

  explicit AssessedFringes(int frames, int height = 100) {
    Pattern pattern{.name = "fringe", .period_px = 20.0};
    pattern.shifts_rad = equal_shifts(frames, kTwoPi / frames);
    stack = render_frames({.height = height, .modulation_counts = 9000.0, .noise_counts = 200.0},
                          pattern,
                          tilted_plane);
    fitted = fit_algorithm("auto", stack, kAssessedNoise);
    map = wrap_phase(stack, fitted.algorithm, kAssessedNoise);
  }
  [[nodiscard]] FrameAssessment assess() const {
    return assess_frames(stack, fitted, map, kAssessedNoise);
  }
  /// Shortest processor time of three assessments, in seconds.
  [[nodiscard]] double seconds() const {
    double shortest_s = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 3; ++run) {
      const std::clock_t start = std::clock();
      EXPECT_FALSE(assess().vibration_suspected);
      const double spent_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      shortest_s = std::min(shortest_s, spent_s);
    }
    return shortest_s;
  }
};

TEST(AssessFrames, FindsTheResidualOfNoiseToBeOne) {
  for (const int frames : {4, 5, 9, 64})
    EXPECT_NEAR(AssessedFringes(frames).assess().residual_ratio, 1.0, 0.03) << frames;
}

TEST(AssessFrames, TheResidualOfFourQuarterStepsIsTheirAlternatingSum) {
  const AssessedFringes fringes(4, 20);
  double sum = 0.0;
  const auto counts = [&](std::size_t frame, std::size_t pixel) {
    return std::visit([&](const auto& image) { return static_cast<double>(image.pixels()[pixel]); },
                      fringes.stack.frames[frame]);
  };
  const std::size_t pixels = fringes.map.status.pixels().size();
  for (std::size_t i = 0; i < pixels; ++i) {
    const double residual = counts(0, i) - counts(1, i) + counts(2, i) - counts(3, i);
    sum += std::min(0.25 * residual * residual / kAssessedNoise.floor_counts2, 25.0);
  }
  EXPECT_NEAR(fringes.assess().residual_ratio, sum / static_cast<double>(pixels), 1e-6);
}

TEST(AssessFrames, TakesTimeLinearInTheFrames) {
  // 8 times the frames; 64 times the time, as before, would be their square.
  EXPECT_LT(AssessedFringes(256, 10).seconds(), 24.0 * AssessedFringes(32, 10).seconds());
}

}  // namespace
}  // namespace frangia
