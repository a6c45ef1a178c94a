#include "frangia/phase/gray/decode_gray_code.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

constexpr int kColumns = 640;
constexpr int kRows = 40;
constexpr double kPeriod_px = 20.0;

/// The projector column that a camera column sees; the scale is not an integer.
double column_of(int x) {
  return 0.93 * x + 3.2;
}

struct Shown {
  WrappedPhase fringes;
  FrameStack gray;
  NoiseModel noise;
};

/// Fringes and Gray code of a camera whose pixels blur the edges of the stripes.
Shown show(InvertedFrames inverted,
           double noise_counts,
           BitOrder order = BitOrder::MostSignificantFirst,
           bool is_binary = false) {
  Pattern pattern{.name = "f", .period_px = kPeriod_px};
  pattern.shifts_rad = testing::equal_shifts(4, 0.5 * kPi);
  const NoiseModel noise{.floor_counts2 = noise_counts * noise_counts + 1.0};
  const FrameStack stack = testing::render_frames(
      {.height = kRows, .noise_counts = noise_counts}, pattern, [](int x, int) {
        return kTwoPi * column_of(x) / kPeriod_px;
      });
  Shown out{wrap_phase(stack, least_squares(pattern.shifts_rad), noise, {.max_sigma_rad = 2.0F}),
            {.pattern = gray_code_for_fringes(pattern, kColumns, inverted), .white_level = 65535},
            noise};
  out.gray.pattern.order = order;
  out.gray.pattern.is_binary = is_binary;
  for (int k = 0; k < out.gray.pattern.frame_count(); ++k) {
    Image<std::uint16_t> image(kColumns, kRows);
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        double lit = 0.0;
        for (int i = -2; i <= 2; ++i)
          lit += is_stripe_bright(out.gray.pattern, k, column_of(x) + 0.4 * i) ? 0.4 : -0.4;
        const auto place =
            hash(hash(100, static_cast<std::uint64_t>(k)),
                 static_cast<std::uint64_t>(y) * kColumns + static_cast<std::uint64_t>(x));
        image(x, y) = static_cast<std::uint16_t>(std::lround(
            std::clamp(30000.0 + 10000.0 * lit + noise_counts * normal_from(place), 0.0, 65535.0)));
      }
    }
    out.gray.frames.emplace_back(std::move(image));
  }
  return out;
}

struct Orders {
  double wrong = 0.0;
  double kept = 0.0;  ///< fractions of all pixels
};

Orders orders_of(const AbsolutePhase& phase) {
  Orders out;
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      out.kept += 1.0 / (kColumns * kRows);
      const double truth = kTwoPi * column_of(x) / kPeriod_px;
      if (std::abs(phase.phase_rad(x, y) - truth) > kPi) out.wrong += 1.0 / (kColumns * kRows);
    }
  }
  return out;
}

TEST(GrayCode, NeighboursDifferInOneBitAndDecodingInvertsEncoding) {
  for (std::uint32_t number = 0; number < 4096; ++number) {
    EXPECT_EQ(gray_to_binary(binary_to_gray(number)), number);
    const std::uint32_t change = binary_to_gray(number) ^ binary_to_gray(number + 1);
    EXPECT_EQ(change & (change - 1), 0U);
  }
}

TEST(DecodeGrayCode, FindsEveryOrderWithAndWithoutInvertedFrames) {
  for (const auto inverted : {InvertedFrames::After, InvertedFrames::None}) {
    const Shown shown = show(inverted, 300.0);
    const Orders orders = orders_of(decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise));
    EXPECT_EQ(orders.wrong, 0.0) << static_cast<int>(inverted);
    EXPECT_GT(orders.kept, 0.999) << static_cast<int>(inverted);
  }
}

TEST(DecodeGrayCode, ReadsEveryRecordedOrderOfFrames) {
  for (const auto inverted :
       {InvertedFrames::After, InvertedFrames::None, InvertedFrames::Alternating}) {
    for (const auto order : {BitOrder::MostSignificantFirst, BitOrder::LeastSignificantFirst}) {
      const Shown shown = show(inverted, 300.0, order);
      const Orders orders =
          orders_of(decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise));
      EXPECT_EQ(orders.wrong, 0.0);
      EXPECT_GT(orders.kept, 0.999);
    }
  }
}

TEST(DecodeGrayCode, ReadsBinaryCodeAndDiscardsTheEdgesOfItsStripes) {
  const Shown shown =
      show(InvertedFrames::Alternating, 300.0, BitOrder::LeastSignificantFirst, true);
  const Orders orders = orders_of(decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise));
  EXPECT_EQ(orders.wrong, 0.0);
  EXPECT_GT(orders.kept, 0.8);
}

TEST(GrayCode, PlacesFramesAsListedByHand) {
  // Three bits, each frame followed by its inverse, narrowest stripes first.
  const Pattern gray{.kind = PatternKind::Gray,
                     .bits = 3,
                     .inverted = InvertedFrames::Alternating,
                     .order = BitOrder::LeastSignificantFirst};
  EXPECT_EQ(gray.frame_count(), 6);
  EXPECT_EQ(frame_of_bit(gray, 0, false), 4);
  EXPECT_EQ(frame_of_bit(gray, 0, true), 5);
  EXPECT_EQ(frame_of_bit(gray, 2, false), 0);
  EXPECT_TRUE(is_stripe_bright(gray, 4, 5.0));  // stripe 5, code 111
  EXPECT_FALSE(is_stripe_bright(gray, 5, 5.0));
  EXPECT_TRUE(is_stripe_bright(gray, 0, 5.0));
  EXPECT_FALSE(is_stripe_bright(gray, 0, 4.0));  // stripe 4, code 110
  EXPECT_THROW(static_cast<void>(is_stripe_bright(gray, 6, 0.0)), Error);
}

TEST(DecodeGrayCode, WrongOrdersStayWithinTheReportedProbability) {
  const Shown shown = show(InvertedFrames::After, 8000.0);
  const Orders all = orders_of(
      decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise, {.max_wrong_order = 1.0}));
  EXPECT_GT(all.wrong, 2e-4);
  const Orders strict = orders_of(
      decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise, {.max_wrong_order = 1e-2}));
  EXPECT_GT(strict.kept, 0.3);
  EXPECT_LT(strict.wrong, 1e-2 * strict.kept);
}

TEST(DecodeGrayCode, RefusesStripesWiderThanAFringeAndOtherDirections) {
  Shown shown = show(InvertedFrames::After, 300.0);
  const auto refuses = [&] {
    EXPECT_THROW(static_cast<void>(decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise)),
                 Error);
  };
  shown.gray.pattern.stripe_px = 21.0;
  refuses();
  shown.gray.pattern.stripe_px = 10.0;
  shown.gray.pattern.direction = FringeDirection::Horizontal;
  refuses();
  EXPECT_THROW(static_cast<void>(decode_gray_code({}, shown.fringes, shown.noise)), Error);
}

}  // namespace
}  // namespace frangia
