#include "frangia/phase/algorithm/fit_algorithm.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::quarter_steps;
using testing::render_frames;
using testing::Scene;
using testing::tilted_plane;

/// Mean and standard deviation of the phase error of a map.
struct Offset {
  double mean = 0.0;
  double rms = 0.0;
};
Offset offset_of(const WrappedPhase& map) {
  double sum = 0.0;
  double square = 0.0;
  for (int y = 0; y < map.phase_rad.height(); ++y) {
    for (int x = 0; x < map.phase_rad.width(); ++x) {
      const double error = wrap_rad(map.phase_rad(x, y) - tilted_plane(x, y));
      sum += error;
      square += error * error;
    }
  }
  const auto n = static_cast<double>(map.phase_rad.pixels().size());
  return {sum / n, std::sqrt(square / n)};
}

TEST(FitAlgorithm, AllAlgorithmsAgreeForAShifterGainError) {
  for (const PublishedAlgorithm& published : published_algorithms()) {
    Pattern pattern = quarter_steps();
    pattern.shifts_rad = example_shifts(published);
    // Three frames do not determine their step, so they come from a shifter without a gain error.
    const double error = pattern.shifts_rad.size() > 3 ? 0.05 : 0.0;
    const Scene scene{.height = 300, .noise_counts = 100.0, .step_error = error};
    const FrameStack stack = render_frames(scene, pattern, tilted_plane);
    const NoiseModel noise{.floor_counts2 = 1e4};
    const FittedAlgorithm fitted = fit_algorithm(published.name, stack, noise);
    const Offset offset = offset_of(wrap_phase(stack, fitted.algorithm, noise));
    EXPECT_NEAR(offset.mean, 0.0, 6e-4) << published.name;
    EXPECT_LT(offset.rms, 0.04) << published.name;
  }
}

TEST(FitAlgorithm, NotesTheChosenAlgorithm) {
  std::string message;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { message = sentence; };
  const FrameStack stack = render_frames({}, quarter_steps(), tilted_plane);
  EXPECT_EQ(fit_algorithm("auto", stack, {}, run).algorithm.name, "schwider");
  EXPECT_EQ(message, "pattern \"fringe\": algorithm schwider, for 4 frames of an interferometer");
}

TEST(FitAlgorithm, WarnsWhenNoShiftsFitTheFrames) {
  Pattern pattern = quarter_steps();
  pattern.shifts_rad = testing::equal_shifts(8, 0.25 * kPi);
  const FrameStack stack =
      render_frames({.height = 50, .noise_counts = 2000.0}, pattern, tilted_plane);
  std::string message;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { message = sentence; };
  const NoiseModel far_too_small{.floor_counts2 = 1e4};
  const PhaseAlgorithm algorithm = fit_algorithm("aia", stack, far_too_small, run).algorithm;
  EXPECT_NE(message.find("no set of shifts fits the frames"), std::string::npos);
  EXPECT_EQ(algorithm.sine, least_squares(pattern.shifts_rad).sine);
}

}  // namespace
}  // namespace frangia
