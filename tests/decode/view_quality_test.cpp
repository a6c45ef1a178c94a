#include "frangia/decode/view_quality.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

FrameAssessment assessed(double contrast, double saturated, int frames, double residual_ratio) {
  FrameAssessment out;
  out.contrast = contrast;
  out.measured_fraction = 1.0 - saturated;
  out.saturated_fraction = saturated;
  out.frames = frames;
  out.residual_ratio = residual_ratio;
  return out;
}

TEST(ViewQuality, IsThatOfTheWorstPatternInEachMeasure) {
  const std::vector<FrameAssessment> patterns = {
      assessed(0.5, 0.1, 4, 1.0), assessed(0.8, 0.3, 4, 0.9), assessed(0.9, 0.0, 3, 7.0)};
  const ViewQuality quality = view_quality(patterns);
  EXPECT_EQ(quality.contrast, 0.5);
  EXPECT_EQ(quality.measured_share, 0.7);
  EXPECT_EQ(quality.saturated_share, 0.3);
  EXPECT_EQ(quality.residual_ratio, 1.0);  // three frames leave no residual
  EXPECT_FALSE(quality.needs_attention);
}

TEST(ViewQuality, IsMissingWithoutFringes) {
  const ViewQuality quality = view_quality({});
  EXPECT_TRUE(std::isnan(quality.contrast));
  EXPECT_TRUE(std::isnan(quality.residual_ratio));
}

TEST(ViewQuality, NeedsAttentionWhereOnePatternDoes) {
  std::vector<FrameAssessment> patterns = {assessed(0.5, 0.0, 4, 1.0), assessed(0.5, 0.0, 4, 9.0)};
  patterns.back().exceeds_noise = true;
  EXPECT_TRUE(view_quality(patterns).needs_attention);
}

}  // namespace
}  // namespace frangia
