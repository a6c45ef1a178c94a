// Three steps at three periods, of which a frame of the coarsest pattern is inverted.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

constexpr int kMapWidth_px = 320;
constexpr int kMapHeight_px = 80;
constexpr double kMapMean_counts = 110.0;

/// `off_px`: how far the columns of the coarsest pattern are from those of the others at most.
std::vector<FrameStack> three_patterns(double off_px = 0.0) {
  std::vector<FrameStack> stacks;
  const testing::Scene scene{.width = kMapWidth_px,
                             .height = kMapHeight_px,
                             .mean_counts = kMapMean_counts,
                             .modulation_counts = 70.0,
                             .noise_counts = 0.6,
                             .white_level = 255};
  for (const double period_px : {1280.0, 80.0, 16.0}) {
    const Pattern pattern{.name = "f" + std::to_string(static_cast<int>(period_px)),
                          .period_px = period_px,
                          .shifts_rad = testing::equal_shifts(3, kTwoPi / 3.0)};
    stacks.push_back(testing::render_frames(scene, pattern, [&](int x, int y) {
      const double off = period_px > 1000.0 ? off_px * std::sin(0.9 * x + 0.7 * y) : 0.0;
      const double column = 100.0 + 3.1 * x + 12.0 * std::sin(0.03 * x + 0.1 * y) + off;
      return kTwoPi * column / period_px;
    }));
  }
  return stacks;
}

SequenceCheck check_of(const std::vector<FrameStack>& stacks, bool keep_maps) {
  Rig rig;
  rig.reference().model.width_px = kMapWidth_px;
  rig.reference().model.height_px = kMapHeight_px;
  rig.reference().noise = NoiseModel{0.4, 0.0};
  rig.projector.model = CameraModel{.width_px = 1280, .height_px = 800};
  const DecodedView view = decode_view(stacks, rig, {}, {.keep_maps = keep_maps});
  return view.directions.front().check.value();
}

TEST(OrdersByChance, AreRefused) {
  for (const bool keep_maps : {true, false}) {
    EXPECT_TRUE(check_of(three_patterns(), keep_maps).consistent);
    const SequenceCheck check = check_of(three_patterns(60.0), keep_maps);
    EXPECT_FALSE(check.consistent);
    EXPECT_EQ(check.patterns, std::vector<std::string>{"f1280"});
    EXPECT_NE(describe(check).find("the fringe orders are little better than chance"),
              std::string::npos)
        << describe(check);
  }
}

}  // namespace
}  // namespace frangia
