// The parts of the explanation of frames, each by itself, on frames of closed formulas.
#include "frangia/decode/explain/internal/covered_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "frangia/decode/explain/internal/frame_sample.h"
#include "frangia/decode/explain/internal/log_densities.h"
#include "frangia/decode/explain/internal/lost_frames.h"
#include "frangia/decode/explain/internal/reference_light.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;

/// Mean, B cos(phi) and B sin(phi) of four steps.
Eigen::MatrixXd values_of(const FrameSample& sample) {
  Eigen::MatrixXd values(sample.counts.rows(), 3);
  values.col(0) = sample.counts.rowwise().mean().matrix();
  values.col(1) = 0.5 * (sample.counts.col(0) - sample.counts.col(2)).matrix();
  values.col(2) = 0.5 * (sample.counts.col(3) - sample.counts.col(1)).matrix();
  return values;
}

TEST(FindCoveredPart, FindsNoneInSoundFrames) {
  RenderedFrames frames({.seed = 51}, 4);
  const FrameStack stack = frames.stack();
  EXPECT_FALSE(find_covered_part(sample_blocks(stack, frames.noise()), stack.pattern));
}

TEST(FindCoveredPart, FindsTheShareThatIsCovered) {
  RenderedFrames frames({.seed = 52}, 6);
  for (std::size_t i = 0; i < frames.frames[4].size(); ++i)
    if (i % 160 >= 120) frames.frames[4][i] = 20.0;
  const FrameStack stack = frames.stack();
  const auto found = find_covered_part(sample_blocks(stack, frames.noise()), stack.pattern);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->hypothesis.part, 1.0 / 3.0, 0.08);
  EXPECT_EQ(found->hypothesis.frames, std::vector<std::size_t>{4});
}

TEST(ReferenceGain, IsPositiveWhereOtherPatternsAgreeAndNegativeElsewhere) {
  RenderedFrames frames({.seed = 53}, 4);
  RenderedFrames fine({.period_px = 9.0, .seed = 53}, 4);
  const FrameStack stack = frames.stack();
  FrameStack reference = fine.stack();
  reference.pattern.period_px = 20.0;
  const std::array references{&reference};
  const FrameSample sample = sample_blocks(stack, frames.noise(), references);
  ASSERT_TRUE(sample.has_reference());
  EXPECT_EQ(sample.reference_phase_rad.size(), sample.counts.rows());
  Eigen::MatrixXd values = values_of(sample);
  const Eigen::ArrayXd all = Eigen::ArrayXd::Ones(values.rows());
  const Eigen::ArrayXd agreed = reference_gain(sample, values, all).pixels;
  EXPECT_GT((agreed > 1.0).cast<double>().mean(), 0.9);
  const Eigen::Index some = values.rows() / 5;
  values.topRows(some) *= 1.6;
  values.col(1).head(some).swap(values.col(2).head(some));  // and another phase
  const Eigen::ArrayXd wrong = reference_gain(sample, values, all).pixels;
  EXPECT_GT((wrong.head(some) < 0.0).cast<double>().mean(), 0.9);
  EXPECT_GT((wrong.tail(values.rows() - some) > 1.0).cast<double>().mean(), 0.9);
}

TEST(LogDensityOfLost, IsHigherOfABlackFrameThanOfFringes) {
  RenderedFrames frames({.seed = 54}, 4);
  const auto density = [&] {
    const FrameSample sample = sample_blocks(frames.stack(), frames.noise());
    const double sum = log_density_of_lost(sample, 1, sample.scale_counts, values_of(sample));
    return sum / static_cast<double>(sample.counts.rows());
  };
  const double of_fringes = density();
  std::fill(frames.frames[1].begin(), frames.frames[1].end(), 6.0);
  EXPECT_GT(density(), of_fringes + 1.0);
}

TEST(LogDensities, AreThoseOfTheNormalDistribution) {
  EXPECT_NEAR(log_normal(0.0, 4.0, 1.0), -std::log(2.0) - 0.918938533, 1e-9);
  EXPECT_NEAR(log_normal(4.0, 4.0, 1.0), -std::log(2.0) - 0.918938533 - 0.5, 1e-9);
  EXPECT_NEAR(log_of_mixture(std::log(0.25), std::log(0.5)), std::log(0.75), 1e-12);
}

}  // namespace
}  // namespace frangia
