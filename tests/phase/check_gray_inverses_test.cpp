// Frames of a Gray code and their inverses by its published formula, with one fault.
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/phase/gray/check_gray_code.h"

namespace frangia {
namespace {

/// A code with bright stripes of up to `bright` counts.
FrameStack code_and_inverses(double bright_counts = 180.0, double sigma_counts = 1.5) {
  FrameStack stack;
  stack.pattern = {.name = "gray", .kind = PatternKind::Gray, .bits = 6, .stripe_px = 10.0};
  stack.pattern.inverted = InvertedFrames::After;
  std::mt19937 generator(4);
  std::normal_distribution<double> noise(0.0, sigma_counts);
  for (const bool inverted : {false, true}) {
    for (int bit = 0; bit < 6; ++bit) {
      Image<std::uint8_t> image(200, 120);
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          const auto number = static_cast<unsigned>((20.0 + 2.9 * x) / 10.0);
          const unsigned code = number ^ (number / 2);
          const bool bright = ((code >> static_cast<unsigned>(5 - bit)) % 2 == 1) != inverted;
          const double albedo = 0.7 + 0.3 * std::sin(0.1 * x + 0.2 * y);
          image(x, y) = static_cast<std::uint8_t>(
              std::lround(20.0 + (bright ? bright_counts * albedo : 0.0) + noise(generator)));
        }
      }
      stack.frames.emplace_back(std::move(image));
    }
  }
  return stack;
}

TEST(CheckGrayInverses, BlamesNoSoundCode) {
  const SequenceCheck found = check_gray_inverses(code_and_inverses());
  EXPECT_TRUE(found.decided);
  EXPECT_TRUE(found.consistent) << found.finding;
}

TEST(CheckGrayInverses, NamesTheFrameThatIsNoInverse) {
  const auto expect_frame_3 = [](const std::function<void(FrameStack&)>& change) {
    FrameStack stack = code_and_inverses();
    change(stack);
    const SequenceCheck found = check_gray_inverses(stack);
    EXPECT_FALSE(found.consistent);
    EXPECT_EQ(found.finding.find("pattern \"gray\": frame 3 and its inverse do not"), 0U)
        << found.finding;
  };
  expect_frame_3([](FrameStack& stack) { stack.frames[3] = Image<std::uint8_t>(200, 120); });
  expect_frame_3([](FrameStack& stack) { stack.frames[3] = stack.frames[2]; });
  expect_frame_3([](FrameStack& stack) { stack.frames[3] = stack.frames[9]; });
}

TEST(CheckGrayInverses, NamesBothFramesThatAreExchanged) {
  FrameStack stack = code_and_inverses();
  std::swap(stack.frames[4], stack.frames[5]);
  EXPECT_NE(check_gray_inverses(stack).finding.find("frames 4, 5 and their inverses"),
            std::string::npos);
}

TEST(CheckGrayInverses, NamesAFrameAtHalfTheLightOfADimCode) {
  constexpr double kBright_counts = 9.0;
  constexpr double kSigma_counts = 0.4;
  const FrameStack sound = code_and_inverses(kBright_counts, kSigma_counts);
  EXPECT_TRUE(check_gray_inverses(sound).decided);
  EXPECT_TRUE(check_gray_inverses(sound).consistent);
  FrameStack half = sound;
  for (std::uint8_t& counts : std::get<Image<std::uint8_t>>(half.frames[9]).pixels())
    counts = static_cast<std::uint8_t>((counts + 1) / 2);
  EXPECT_FALSE(check_gray_inverses(half).consistent);
  // Bright stripes within the noise say nothing.
  EXPECT_FALSE(check_gray_inverses(code_and_inverses(1.0, kSigma_counts)).decided);
}

}  // namespace
}  // namespace frangia
