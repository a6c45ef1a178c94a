#include "frangia/phase/waveform/frame_samples.h"

#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/phase/internal/sample_columns.h"

namespace frangia {
namespace {

/// Two frames of 24 x 16 pixels, whose counts are x + 24 y and twice that.
FrameStack numbered_frames() {
  FrameStack stack{.pattern = {.name = "numbered"}, .frames = {}, .white_level = 1000};
  for (int k = 1; k <= 2; ++k) {
    Image<std::uint16_t> image(24, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 24; ++x)
        image(x, y) = static_cast<std::uint16_t>(k * (x + 24 * y));
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

TEST(SampleFrames, TakesAGridWithOneStrideAlongXAndY) {
  const Eigen::ArrayXXf counts = sample_frames(numbered_frames(), 24 * 16 / 9);
  ASSERT_EQ(counts.rows(), 8 * 6);
  ASSERT_EQ(counts.cols(), 2);
  for (Eigen::Index row = 0; row < counts.rows(); ++row) {
    const auto number = static_cast<float>(3 * (row % 8) + 24 * 3 * (row / 8));
    EXPECT_EQ(counts(row, 0), number);
    EXPECT_EQ(counts(row, 1), 2.0F * number);
  }
}

TEST(SampleFrames, TakesThePixelsAtTheEndsOfAnOddStride) {
  EXPECT_EQ(sample_frames(numbered_frames(), 16).rows(), 6 * 4);  // a stride of 4
  EXPECT_EQ(sample_frames(numbered_frames(), 24 * 16 / 25).rows(), 5 * 4);
  EXPECT_EQ(sample_frames(numbered_frames(), 1'000'000).rows(), 24 * 16);
  EXPECT_GE(sample_frames(numbered_frames(), 0).rows(), 1);
}

TEST(SampleFrames, LeavesOutPixelsThatAreSaturatedInAnyFrame) {
  FrameStack stack = numbered_frames();
  stack.white_level = 500;  // the second frame reaches it from pixel 250
  EXPECT_EQ(sample_frames(stack, 24 * 16).rows(), 250);
}

TEST(SampleBox, CutsTheSamePixelsOutOfAllFrames) {
  const FrameStack cut = sample_box(numbered_frames(), {3, 2, 8, 16});
  ASSERT_EQ(cut.frames.size(), 2U);
  ASSERT_EQ(width_of(cut.frames[1]), 5);
  ASSERT_EQ(height_of(cut.frames[1]), 14);
  EXPECT_EQ(counts_at(cut.frames[1], 0, 0), 2 * (3 + 24 * 2));
  EXPECT_EQ(counts_at(cut.frames[0], 4, 13), 7 + 24 * 15);
  EXPECT_EQ(cut.white_level, 1000);
}

TEST(SampleBox, RefusesABoxThatLeavesTheFrames) {
  EXPECT_THROW(static_cast<void>(sample_box(numbered_frames(), {0, 0, 25, 3})), Error);
}

TEST(SampleRows, TakesEvenlySpacedRows) {
  const FrameStack some = sample_rows(numbered_frames(), 24 * 4);
  ASSERT_EQ(some.frames.size(), 2U);
  ASSERT_EQ(height_of(some.frames[1]), 4);
  ASSERT_EQ(width_of(some.frames[1]), 24);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 24; ++x)
      EXPECT_EQ(counts_at(some.frames[1], x, y), 2 * (x + 24 * 4 * y));
  }
  EXPECT_EQ(height_of(sample_rows(numbered_frames(), 24 * 5).frames[0]), 6) << "every third row";
  EXPECT_EQ(height_of(sample_rows(numbered_frames(), 1).frames[0]), 1);
  const FrameStack bands = sample_rows(numbered_frames(), 24 * 6, 3);
  ASSERT_EQ(height_of(bands.frames[0]), 9) << "every second band of three";
  for (int y = 0; y < 9; ++y)
    EXPECT_EQ(counts_at(bands.frames[0], 0, y), 24 * (y / 3 * 6 + y % 3));
  EXPECT_EQ(height_of(sample_rows(numbered_frames(), 1'000'000).frames[0]), 16);
}

TEST(SampleColumns, TakesEvenlySpacedColumnsAsRows) {
  const FrameStack some = sample_columns(numbered_frames(), 16 * 6);
  ASSERT_EQ(some.frames.size(), 2U);
  ASSERT_EQ(height_of(some.frames[1]), 6);
  ASSERT_EQ(width_of(some.frames[1]), 16);
  for (int row = 0; row < 6; ++row) {
    for (int y = 0; y < 16; ++y)
      EXPECT_EQ(counts_at(some.frames[1], y, row), 2 * (4 * row + 24 * y));
  }
  EXPECT_EQ(height_of(sample_columns(numbered_frames(), 16 * 5).frames[0]), 6) << "every fourth";
  EXPECT_EQ(height_of(sample_columns(numbered_frames(), 16 * 9).frames[0]), 12) << "every other";
  EXPECT_EQ(height_of(sample_columns(numbered_frames(), 1).frames[0]), 1);
  EXPECT_EQ(height_of(sample_columns(numbered_frames(), 1'000'000).frames[0]), 24);
}

TEST(SamplePixels, TakesTheGivenPixelsInOneRow) {
  const std::vector<std::uint32_t> pixels = {3, 24 * 2 + 5, 24 * 15 + 23};
  const FrameStack some = sample_pixels(numbered_frames(), pixels);
  ASSERT_EQ(width_of(some.frames[1]), 3);
  ASSERT_EQ(height_of(some.frames[1]), 1);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(counts_at(some.frames[1], i, 0),
              static_cast<int>(2 * pixels[static_cast<std::size_t>(i)]));
  EXPECT_EQ(some.white_level, 1000);
}

}  // namespace
}  // namespace frangia
