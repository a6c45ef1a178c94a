#include "frangia/decode/explain_no_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"

namespace frangia {
namespace {

constexpr int kFlatFrame_px = 64;

/// Four frames of fringes of 16 pixels, decoded without a rig.
std::string reason_of(double mean, double amplitude) {
  Rig rig;
  rig.reference().model.width_px = kFlatFrame_px;
  rig.reference().model.height_px = kFlatFrame_px;
  rig.projector.model = PinholeModel{};
  FrameStack stack;
  stack.pattern.name = "fine";
  stack.pattern.kind = PatternKind::Fringe;
  stack.pattern.period_px = 16.0;
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int step = 0; step < 4; ++step) {
    stack.pattern.shifts_rad.push_back(kTwoPi * step / 4);
    Image<std::uint8_t> frame(kFlatFrame_px, kFlatFrame_px);
    for (int y = 0; y < kFlatFrame_px; ++y) {
      for (int x = 0; x < kFlatFrame_px; ++x) {
        const double light =
            mean + amplitude * std::cos(kTwoPi * (x / 16.0 + step / 4.0)) + noise(generator);
        frame(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(light), 0L, 255L));
      }
    }
    stack.frames.emplace_back(std::move(frame));
  }
  const std::array<FrameStack, 1> stacks{std::move(stack)};
  return explain_no_phase(stacks, decode_view(stacks, rig, {}).directions.front().phase.status);
}

TEST(ExplainNoPhase, NamesDarkFramesAndHowMuchLongerToExpose) {
  const std::string reason = reason_of(3.0, 0.2);
  EXPECT_NE(reason.find("the frames are dark"), std::string::npos) << reason;
  EXPECT_NE(reason.find("times longer"), std::string::npos) << reason;
}

TEST(ExplainNoPhase, NamesSaturatedFrames) {
  const std::string reason = reason_of(600.0, 100.0);
  EXPECT_NE(reason.find("100 % of the pixels are saturated; expose shorter"), std::string::npos)
      << reason;
}

TEST(ExplainNoPhase, NamesFramesWithoutFringes) {
  const std::string reason = reason_of(120.0, 0.0);
  EXPECT_NE(reason.find("no frame shows fringes beyond the noise"), std::string::npos) << reason;
}

TEST(ExplainNoPhase, IsSilentWhereAPixelHasAPhase) {
  EXPECT_EQ(reason_of(120.0, 60.0), "");
}

}  // namespace
}  // namespace frangia
