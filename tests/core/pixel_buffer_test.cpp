#include "frangia/core/pixel_buffer.h"

#include <utility>

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(PixelBuffer, CopiesItsElements) {
  PixelBuffer<int> a(3, 7);
  PixelBuffer<int> b = a;
  b[1] = 8;
  EXPECT_EQ(a[1], 7);
  a = b;
  EXPECT_EQ(a[1], 8);
  a = PixelBuffer<int>(5, 1);
  b = a;
  EXPECT_EQ(b.size(), 5U);
  EXPECT_EQ(b[4], 1);
}

TEST(PixelBuffer, IsEmptyAfterItsMemoryMoved) {
  PixelBuffer<int> a(3, 7);
  PixelBuffer<int> b = std::move(a);
  EXPECT_TRUE(a.empty());  // NOLINT(bugprone-use-after-move)
  PixelBuffer<int> c(2, 1);
  c = std::move(b);
  EXPECT_TRUE(b.empty());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(c[2], 7);
  EXPECT_EQ(PixelBuffer<int>(0, 7).data(), nullptr);
}

}  // namespace
}  // namespace frangia
