// Frames of four steps that are exchanged, beside a Gray code; made by the published formulas.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/decode_view.h"

namespace frangia {
namespace {

constexpr int kAcross_px = 320;
constexpr int kDown_px = 48;
constexpr double kFringe_px = 20.0;

/// A frame of light from -1 to 1 at the projector's columns, of which a pixel is 1.85 wide.
template <typename Light>
Image<std::uint8_t> frame_of(const Light& light, std::mt19937& generator) {
  std::normal_distribution<double> noise(0.0, 1.5);
  Image<std::uint8_t> image(kAcross_px, kDown_px);
  for (int y = 0; y < kDown_px; ++y) {
    for (int x = 0; x < kAcross_px; ++x) {
      const double column = 20.0 + 1.85 * x + 8.0 * std::sin(0.03 * x + 0.1 * y);
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(110.0 + 70.0 * light(column) + noise(generator)));
    }
  }
  return image;
}

TEST(ExchangedFrames, AreDecidedByTheGrayCode) {
  std::mt19937 generator(3);
  FrameStack gray;
  gray.pattern = {.name = "gray", .kind = PatternKind::Gray, .bits = 6, .stripe_px = 10.0};
  for (int bit = 5; bit >= 0; --bit) {
    gray.frames.emplace_back(frame_of(
        [&](double column) {
          const auto number = static_cast<unsigned>(std::floor((column + 0.5) / 10.0));
          return ((number ^ (number / 2)) >> static_cast<unsigned>(bit)) % 2 == 1 ? 1.0 : -1.0;
        },
        generator));
  }
  FrameStack fringes;
  fringes.pattern = {
      .name = "f", .period_px = kFringe_px, .shifts_rad = {0.0, 0.5 * kPi, kPi, 1.5 * kPi}};
  for (const double shift : {0.0, kPi, 0.5 * kPi, 1.5 * kPi}) {  // 1 and 2 exchanged
    fringes.frames.emplace_back(frame_of(
        [&](double column) { return std::cos(kTwoPi * column / kFringe_px + shift); }, generator));
  }
  Rig rig;
  rig.reference().model.width_px = kAcross_px;
  rig.reference().model.height_px = kDown_px;
  rig.reference().noise = NoiseModel{2.3, 0.0};
  rig.projector.model = CameraModel{.width_px = 640, .height_px = 480};
  const std::vector<FrameStack> stacks{std::move(gray), std::move(fringes)};
  const DecodedView view = decode_view(stacks, rig, {});
  const auto& check = view.directions.front().check;
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->consistent);
  ASSERT_EQ(check->fits.size(), 1U) << describe(*check);
  EXPECT_EQ(check->fits[0].what, "frames 1 and 2 exchanged");
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const DecodedView again = decode_view(stacks, rig, {}, {.accept_remedy = true}, run);
  ASSERT_TRUE(again.directions.front().check);
  EXPECT_TRUE(again.directions.front().check->consistent)
      << describe(*again.directions.front().check);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("decoded with the shifts that fit"), std::string::npos) << warnings[0];
}

TEST(ExchangedFrames, AreNamedAllWhereNothingDecidesBetweenThem) {
  // Two exchanges differ by the direction of the fringes only, which one pattern does not show.
  std::mt19937 generator(5);
  FrameStack fringes;
  fringes.pattern = {.name = "f", .period_px = kFringe_px, .shifts_rad = {}};
  for (int k = 0; k < 5; ++k)
    fringes.pattern.shifts_rad.push_back(kTwoPi * k / 5);
  for (const int k : {0, 2, 1, 3, 4}) {
    fringes.frames.emplace_back(frame_of(
        [&](double column) { return std::cos(kTwoPi * column / kFringe_px + kTwoPi * k / 5); },
        generator));
  }
  Rig rig;
  rig.reference().model.width_px = kAcross_px;
  rig.reference().model.height_px = kDown_px;
  rig.reference().noise = NoiseModel{2.3, 0.0};
  rig.projector.model = CameraModel{.width_px = 640, .height_px = 480};
  const std::vector<FrameStack> alone{std::move(fringes)};
  const DecodedView view = decode_view(alone, rig, {});
  const auto& check = view.directions.front().check;
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->consistent);
  ASSERT_EQ(check->fits.size(), 2U) << describe(*check);
  EXPECT_EQ(check->fits.front().what, "frames 0 and 3 exchanged");
  EXPECT_EQ(check->fits.back().what, "frames 1 and 2 exchanged");
}

}  // namespace
}  // namespace frangia
