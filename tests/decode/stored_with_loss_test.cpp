// Frames that were stored with few levels differ by more than the noise that they show, and by no
// more than their levels do.
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"

namespace frangia {
namespace {

/// Four steps on a shaded surface, by a camera of 24 levels.
FrameStack few_levels() {
  constexpr double kStep = 255.0 / 23.0;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 1.0);
  FrameStack stack;
  stack.pattern = {.name = "f", .period_px = 20.0, .shifts_rad = {}};
  for (int k = 0; k < 4; ++k) {
    stack.pattern.shifts_rad.push_back(kTwoPi * k / 4);
    Image<std::uint8_t> frame(240, 160);
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const double phase = 0.4 * x + std::sin(0.05 * y) + stack.pattern.shifts_rad.back();
        const double albedo = 0.5 + 0.5 * std::cos(0.01 * x - 0.02 * y);
        const double light = 8.0 + albedo * (110.0 + 90.0 * std::cos(phase)) + noise(random);
        frame(x, y) = static_cast<std::uint8_t>(std::lround(std::round(light / kStep) * kStep));
      }
    }
    stack.frames.emplace_back(std::move(frame));
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
