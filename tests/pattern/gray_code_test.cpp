#include "frangia/pattern/gray_code.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace frangia {
namespace {

Pattern gray_of(InvertedFrames inverted, BitOrder order = BitOrder::MostSignificantFirst) {
  return {.name = "g", .kind = PatternKind::Gray, .bits = 3, .inverted = inverted, .order = order};
}

TEST(GrayCode, ShowsEachBitInTheFrameThatItsOrderStates) {
  const Pattern after = gray_of(InvertedFrames::After);
  const Pattern alternating = gray_of(InvertedFrames::Alternating);
  const Pattern reversed = gray_of(InvertedFrames::Alternating, BitOrder::LeastSignificantFirst);
  for (int bit = 0; bit < 3; ++bit) {
    EXPECT_EQ(frame_of_bit(after, bit, false), bit);
    EXPECT_EQ(frame_of_bit(after, bit, true), 3 + bit);
    EXPECT_EQ(frame_of_bit(alternating, bit, false), 2 * bit);
    EXPECT_EQ(frame_of_bit(alternating, bit, true), 2 * bit + 1);
    EXPECT_EQ(frame_of_bit(reversed, bit, false), 4 - 2 * bit);
    EXPECT_EQ(frame_of_bit(reversed, bit, true), 5 - 2 * bit);
  }
}

TEST(GrayCode, HasTheColumnAtTheCentreOfTheStripe) {
  Pattern gray = gray_of(InvertedFrames::None);
  gray.stripe_px = 4.0;
  // Stripe 2 covers columns 8 to 11, whose codes are 2 ^ 1 = 3.
  EXPECT_EQ(column_of_code(gray, 3), 9.5);
  gray.offset_px = 1.0;
  EXPECT_EQ(column_of_code(gray, 3), 8.5);
  gray.is_binary = true;
  EXPECT_EQ(column_of_code(gray, 3), 12.5);
}

TEST(GrayCode, LightsTheStripesFromEdgeToEdge) {
  Pattern gray = gray_of(InvertedFrames::Alternating);
  gray.stripe_px = 4.0;
  constexpr std::array<bool, 8> kLast{false, true, true, false, false, true, true, false};
  for (int stripe = 0; stripe < 8; ++stripe) {
    for (const double column : {4.0 * stripe - 0.49, 4.0 * stripe + 3.49}) {
      const bool bright = kLast.at(static_cast<std::size_t>(stripe));
      EXPECT_EQ(is_stripe_bright(gray, 4, column), bright) << column;
      EXPECT_EQ(is_stripe_bright(gray, 5, column), !bright) << column;
      EXPECT_EQ(is_stripe_bright(gray, 0, column), stripe >= 4) << column;
    }
  }
}

}  // namespace
}  // namespace frangia
