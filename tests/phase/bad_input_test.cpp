// Tiny, huge and completely saturated images through every stage from frames to phase.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "frangia/core/angles.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/spatial/find_residues.h"
#include "frangia/phase/spatial/unwrap_spatially.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/decode_sequence.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/fill_enclosed.h"
#include "frangia/phase/wrap/merge_exposures.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::quarter_steps;
using testing::render_frames;

double ramp(int x, int y) {
  return 0.05 * x + 0.03 * y;
}

TEST(SmallImages, OfOnePixelRowOrColumnAreDecodedByEveryStage) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {300, 1}, {2, 2}}) {
    const FrameStack stack =
        render_frames({.width = width, .height = height}, quarter_steps(), ramp);
    const NoiseModel noise = estimate_noise({&stack, 1});
    const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
    const WrappedPhase map = wrap_phase(stack, fitted.algorithm, noise);
    EXPECT_FALSE(assess_frames(stack, fitted, map, noise).exceeds_noise);
    EXPECT_TRUE(find_residues(map.phase_rad).empty());
    for (const SpatialMethod method : {SpatialMethod::RunMerging,
                                       SpatialMethod::QualityGuided,
                                       SpatialMethod::ReliabilitySorted}) {
      const RelativePhase found = unwrap_spatially(map, {.method = method});
      ASSERT_EQ(found.region_count, 1) << width << " x " << height;
      const double turns = std::round((found.phase_rad(0, 0) - ramp(0, 0)) / kTwoPi);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
          ASSERT_NEAR(found.phase_rad(x, y) - kTwoPi * turns, ramp(x, y), 1e-3);
      }
    }
    const WrappedPhase merged = merge_exposures({&stack, 1}, stack.pattern.shifts_rad, noise);
    EXPECT_NEAR(merged.phase_rad(0, 0), ramp(0, 0), 1e-3);
    AbsolutePhase absolute{map.pattern, map.phase_rad, map.sigma_rad, map.status};
    EXPECT_EQ(fill_enclosed(absolute), 0U);
  }
}

TEST(SmallImages, OfASequenceAreDecoded) {
  Projector projector;
  projector.model = CameraModel{.width_px = 640, .height_px = 4, .focal_px = {800.0, 800.0}};
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}}) {
    std::vector<FrameStack> stacks;
    for (const double fringes : {1.0, 4.0, 16.0}) {
      Pattern pattern = quarter_steps(0.0);
      pattern.period_px = 640.0 / fringes;
      stacks.push_back(render_frames({.width = width, .height = height}, pattern, [&](int, int) {
        return kTwoPi * fringes * 200.0 / 640.0;
      }));
    }
    std::vector<SequenceFrames> maps;
    std::vector<WrappedPhase> wrapped;
    for (const FrameStack& stack : stacks) {
      maps.push_back({&stack, least_squares(stack.pattern.shifts_rad)});
      wrapped.push_back(wrap_phase(stack, maps.back().algorithm, {}));
    }
    const double truth = kTwoPi * 16.0 * 200.0 / 640.0;
    const AbsolutePhase once = decode_sequence(maps, {}, projector);
    const AbsolutePhase unwrapped = unwrap_temporally(wrapped, projector);
    EXPECT_NEAR(once.phase_rad(0, height - 1), truth, 1e-3);
    EXPECT_NEAR(unwrapped.phase_rad(0, height - 1), truth, 1e-3);
  }
}

TEST(SaturatedImages, HaveTheStatusSaturatedEverywhere) {
  FrameStack stack = render_frames({.mean_counts = 1e7}, quarter_steps(), ramp);
  const NoiseModel noise = estimate_noise({&stack, 1});
  EXPECT_DOUBLE_EQ(noise.variance(1000.0), 1.0 / 12.0);
  const FittedAlgorithm fitted = fit_algorithm("auto", stack, noise);
  EXPECT_FALSE(fitted.step.found);
  const WrappedPhase map = wrap_phase(stack, fitted.algorithm, noise);
  const auto statuses = map.status.pixels();
  EXPECT_TRUE(std::all_of(statuses.begin(), statuses.end(), [](PixelStatus status) {
    return status == PixelStatus::Saturated;
  }));
  const FrameAssessment assessment = assess_frames(stack, fitted, map, noise);
  EXPECT_EQ(assessment.saturated_fraction, 1.0);
  EXPECT_FALSE(assessment.exceeds_noise);
  EXPECT_EQ(unwrap_spatially(map, {.keep_growth_order = true}).region_count, 0);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

TEST(HugeImages, Of100MegapixelsUseMemoryForFramesAndResultOnly) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers allocate memory of their own";
#endif
  constexpr int kSide = 10'000;
  Projector projector;
  projector.model = CameraModel{.width_px = kSide, .height_px = 4, .focal_px = {1.0, 1.0}};
  Pattern pattern{.name = "one", .period_px = kSide, .shifts_rad = testing::equal_shifts(3, 2.0)};
  FrameStack stack{.pattern = pattern, .frames = {}, .white_level = 255};
  for (const double shift : pattern.shifts_rad) {
    std::vector<std::uint8_t> row(kSide);
    for (int x = 0; x < kSide; ++x) {
      row[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(
          std::lround(120.0 + 100.0 * std::cos(kTwoPi * x / kSide + shift)));
    }
    Image<std::uint8_t> image(kSide, kSide, Uninitialized{});
    for (int y = 0; y < kSide; ++y)
      std::copy(row.begin(), row.end(), &image(0, y));
    stack.frames.emplace_back(std::move(image));
  }
  const SequenceFrames map{&stack, least_squares(pattern.shifts_rad)};
  const double before = peak_mb();
  const AbsolutePhase phase = decode_sequence({&map, 1}, {}, projector);
  const double result_mb = 1e8 * (4.0 + 4.0 + 1.0) / (1024.0 * 1024.0);
  EXPECT_LT(peak_mb() - before, result_mb + 32.0);
  for (const int at : {500, 5000, 9500}) {
    EXPECT_NEAR(phase.phase_rad(at, kSide - 1), kTwoPi * at / kSide, 0.01);
    EXPECT_EQ(phase.phase_rad(at, 0), phase.phase_rad(at, kSide - 1));
  }
}

}  // namespace
}  // namespace frangia
