#include "frangia/phase/decode_gray_code.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/wrap_phase.h"

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
Shown show(bool inverted, double noise_counts) {
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
  for (const bool inverted : {true, false}) {
    const Shown shown = show(inverted, 300.0);
    const Orders orders = orders_of(decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise));
    EXPECT_EQ(orders.wrong, 0.0) << inverted;
    EXPECT_GT(orders.kept, 0.999) << inverted;
  }
}

TEST(DecodeGrayCode, WrongOrdersStayWithinTheReportedProbability) {
  const Shown shown = show(true, 8000.0);
  const Orders all = orders_of(
      decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise, {.max_wrong_order = 1.0}));
  EXPECT_GT(all.wrong, 2e-4);
  const Orders strict = orders_of(
      decode_gray_code({&shown.gray, 1}, shown.fringes, shown.noise, {.max_wrong_order = 1e-2}));
  EXPECT_GT(strict.kept, 0.3);
  EXPECT_LT(strict.wrong, 1e-2 * strict.kept);
}

TEST(DecodeGrayCode, RefusesStripesWiderThanAFringeAndOtherDirections) {
  Shown shown = show(true, 300.0);
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
