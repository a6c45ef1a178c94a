// Frames of Gray and binary codes by their published formulas, declared wrongly.
#include "frangia/phase/gray/check_gray_neighbours.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace frangia {
namespace {

constexpr int kCodedBits = 6;

/// A bent part before a wall: columns rise along the rows, and jump at both ends of the part.
double stripe_column(int x, int y) {
  const bool on_part = x > 60 && x < 150 && y > 20 && y < 100;
  return on_part ? 80.0 + 2.1 * x + 6.0 * std::sin(0.05 * y) : 20.0 + 2.4 * x;
}

FrameStack neighbour_frames(bool is_binary, bool with_inverses = false) {
  FrameStack stack;
  stack.pattern = {
      .name = "gray", .kind = PatternKind::Gray, .bits = kCodedBits, .stripe_px = 10.0};
  stack.pattern.is_binary = is_binary;
  if (with_inverses) stack.pattern.inverted = InvertedFrames::After;
  std::mt19937 generator(4);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (const bool inverted : {false, true}) {
    if (inverted && !with_inverses) continue;
    for (int bit = 0; bit < kCodedBits; ++bit) {
      Image<std::uint8_t> image(220, 120);
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          const auto number = static_cast<unsigned>(stripe_column(x, y) / 10.0);
          const unsigned code = is_binary ? number : number ^ (number / 2);
          const bool bright =
              ((code >> static_cast<unsigned>(kCodedBits - 1 - bit)) % 2 == 1) != inverted;
          const double albedo = 0.7 + 0.3 * std::sin(0.1 * x + 0.2 * y);
          image(x, y) = static_cast<std::uint8_t>(
              std::lround(20.0 + (bright ? 180.0 * albedo : 0.0) + noise(generator)));
        }
      }
      stack.frames.emplace_back(std::move(image));
    }
  }
  return stack;
}

/// The single declaration that the check names.
std::string fitted_name(const FrameStack& stack) {
  const SequenceCheck found = check_gray_neighbours(stack);
  EXPECT_TRUE(found.decided);
  EXPECT_FALSE(found.consistent) << found.agreement;
  EXPECT_EQ(found.fits.size(), 1U);
  return found.fits.empty() ? "" : found.fits.front().what;
}

TEST(CheckGrayNeighbours, BlamesNoSoundCode) {
  for (const bool is_binary : {false, true}) {
    const SequenceCheck found = check_gray_neighbours(neighbour_frames(is_binary));
    EXPECT_TRUE(found.decided);
    EXPECT_TRUE(found.consistent) << is_binary << ' ' << found.agreement;
  }
}

/// A code of 9 bits whose stripes of one column are narrower than the pixels, with its inverses.
FrameStack narrow_stripes(double columns_per_px, bool exchanged = false) {
  constexpr int kBits = 9;
  FrameStack stack;
  stack.pattern = {.name = "gray", .kind = PatternKind::Gray, .bits = kBits, .stripe_px = 1.0};
  std::mt19937 generator(6);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int bit = 0; bit < kBits; ++bit) {
    Image<std::uint8_t> image(200, 100);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        double light = 0.0;
        constexpr int kSamples = 20;
        for (int i = 0; i < kSamples; ++i) {
          const double place = x + (i + 0.5) / kSamples;
          const auto number =
              static_cast<unsigned>(20.0 + columns_per_px * place + 6.0 * std::sin(0.05 * y));
          const unsigned code = number ^ (number / 2);
          if ((code >> static_cast<unsigned>(kBits - 1 - bit)) % 2 == 1) light += 1.0 / kSamples;
        }
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(20.0 + 160.0 * light + noise(generator)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  if (exchanged) std::swap(stack.frames[1], stack.frames[4]);
  return stack;
}

TEST(CheckGrayNeighbours, BlamesNoCodeWhoseStripesAreAsNarrowAsPixels) {
  for (const double columns_per_px : {0.7, 1.0, 1.3, 1.6, 2.2}) {
    const SequenceCheck found = check_gray_neighbours(narrow_stripes(columns_per_px));
    EXPECT_TRUE(found.consistent) << columns_per_px << ' ' << describe(found);
    const SequenceCheck wrong = check_gray_neighbours(narrow_stripes(columns_per_px, true));
    EXPECT_FALSE(wrong.consistent) << columns_per_px;
  }
}

TEST(CheckGrayNeighbours, NamesTheOtherCode) {
  for (const bool with_inverses : {false, true}) {
    FrameStack stack = neighbour_frames(true, with_inverses);
    stack.pattern.is_binary = false;
    EXPECT_EQ(fitted_name(stack), "the other code");
    stack = neighbour_frames(false, with_inverses);
    stack.pattern.is_binary = true;
    EXPECT_EQ(fitted_name(stack), "the other code");
  }
}

TEST(CheckGrayNeighbours, NamesTheOppositeOrder) {
  FrameStack stack = neighbour_frames(false);
  stack.pattern.order = BitOrder::LeastSignificantFirst;
  EXPECT_EQ(fitted_name(stack), "its bits in the opposite order");
}

TEST(CheckGrayNeighbours, NamesFramesThatAreExchanged) {
  FrameStack stack = neighbour_frames(false);
  std::swap(stack.frames[3], stack.frames[4]);
  EXPECT_EQ(fitted_name(stack), "frames 3 and 4 exchanged");
}

TEST(CheckGrayNeighbours, NamesAFrameWithoutStripes) {
  for (const int counts : {0, 255}) {
    FrameStack stack = neighbour_frames(false);
    stack.frames[4] = Image<std::uint8_t>(220, 120, static_cast<std::uint8_t>(counts));
    SCOPED_TRACE(counts);
    EXPECT_EQ(fitted_name(stack), "a missing frame: frame 4 shows no stripes");
  }
}

TEST(CheckGrayNeighbours, SaysThatNothingExplainsNumbersThatJump) {
  FrameStack stack = neighbour_frames(false);
  std::swap(stack.frames[1], stack.frames[3]);
  std::swap(stack.frames[2], stack.frames[5]);
  const SequenceCheck found = check_gray_neighbours(stack);
  EXPECT_FALSE(found.consistent) << found.agreement;
  EXPECT_TRUE(found.fits.empty());
  EXPECT_NE(found.finding.find("no other order of the frames explains it"), std::string::npos);
}

}  // namespace
}  // namespace frangia
