// Frames that were stored with few levels differ by more than the noise that they show, and by no
// more than their levels do.
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/decode/decode_view.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

/// Four steps by a camera of 24 levels.
FrameStack few_levels() {
  constexpr double kStep = 255.0 / 23.0;
  const testing::RenderedScene scene{.width = 240, .height = 160, .noise = 1.0, .seed = 5};
  FrameStack stack = testing::RenderedFrames(scene, 4).stack();
  for (Frame& frame : stack.frames) {
    for (std::uint8_t& counts : std::get<Image<std::uint8_t>>(frame).pixels())
      counts = static_cast<std::uint8_t>(std::lround(std::round(counts / kStep) * kStep));
  }
  return stack;
}

TEST(StoredWithLoss, IsSaidOnceAndIsNoOtherFault) {
  const std::vector<FrameStack> captured{few_levels()};
  Rig rig;
  rig.reference().model.width_px = 240;
  rig.reference().model.height_px = 160;
  rig.projector.model = CameraModel{.width_px = 640, .height_px = 480};
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const DecodedView view = decode_view(captured, rig, {}, {}, run);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.front().find("few levels, 11 counts apart"), std::string::npos)
      << warnings.front();
  for (const std::string& warning : warnings) {
    EXPECT_EQ(warning.find("contradict"), std::string::npos) << warning;
    EXPECT_EQ(warning.find("differ"), std::string::npos) << warning;
  }
  const FrameAssessment assessment = assessments_of(view).front();
  EXPECT_FALSE(assessment.exceeds_noise);
  // What is stated is not searched for, and a loss that is not counted makes frames differ.
  DecodeOptions lossless;
  lossless.storage_counts2 = 0.0;
  warnings.clear();
  const DecodedView uncounted = decode_view(captured, rig, {}, lossless, run);
  EXPECT_TRUE(assessments_of(uncounted).front().exceeds_noise);
  for (const std::string& warning : warnings)
    EXPECT_EQ(warning.find("few levels"), std::string::npos) << warning;
}

}  // namespace
}  // namespace frangia
