#include "frangia/phase/wrap/smooth_jumps.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr int kJumpColumns = 90;
constexpr int kJumpRows = 70;  // more than two bands of rows

/// The wrapped phase of `phase_of(x, y)`; transposed, so that what runs along x runs along y.
template <typename Phase>
Image<float> wrapped_image(const Phase& phase_of, bool transposed) {
  Image<float> image(transposed ? kJumpRows : kJumpColumns, transposed ? kJumpColumns : kJumpRows);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double phase = transposed ? phase_of(y, x) : phase_of(x, y);
      image(x, y) = static_cast<float>(wrap_rad(phase));
    }
  }
  return image;
}

/// The masks along x of an image and along y of the transposed one must be the transposed of each
/// other; returns the first.
template <typename Phase>
Image<std::uint8_t> smooth_along(const Phase& phase_of, const JumpOptions& options = {}) {
  const Image<std::uint8_t> right = smooth_right(wrapped_image(phase_of, false), options);
  const Image<std::uint8_t> below = smooth_below(wrapped_image(phase_of, true), options);
  for (int y = 0; y < kJumpRows; ++y) {
    for (int x = 0; x < kJumpColumns; ++x)
      EXPECT_EQ(right(x, y), below(y, x)) << x << " " << y;
  }
  return right;
}

TEST(SmoothJumps, OfASlopeAreAllButTheLast) {
  const auto smooth = smooth_along([](int x, int y) { return 0.9 * x + 0.3 * y; });
  for (int y = 0; y < kJumpRows; ++y) {
    for (int x = 0; x < kJumpColumns; ++x)
      EXPECT_EQ(smooth(x, y), x + 1 < kJumpColumns ? 1 : 0) << x << " " << y;
  }
}

TEST(SmoothJumps, EndAtADepthStepAndNotAtACrease) {
  for (const double step : {0.5, -0.5, 3.0}) {
    const auto smooth = smooth_along(
        [&](int x, int) { return (x < 40 ? 0.5 * x : 0.8 * x - 12.0) + (x > 60 ? step : 0.0); });
    for (int x = 0; x + 1 < kJumpColumns; ++x)
      EXPECT_EQ(smooth(x, 7), x != 60 ? 1 : 0) << x;
  }
}

TEST(SmoothJumps, DepartByLessThanTheTolerance) {
  for (const double step : {0.09, 0.11, -0.09, -0.11}) {
    const auto smooth = smooth_along([&](int x, int) { return 0.5 * x + (x > 60 ? step : 0.0); });
    EXPECT_EQ(smooth(60, 7), std::abs(step) < 0.1 ? 1 : 0) << step;
  }
}

TEST(SmoothJumps, AreBelowTheLargestJump) {
  for (const double slope : {2.0, 2.15, -2.0, -2.15}) {
    const auto smooth = smooth_along([&](int x, int) { return slope * x; });
    EXPECT_EQ(smooth(30, 7), std::abs(slope) < 2.09 ? 1 : 0) << slope;
  }
}

TEST(SmoothJumps, AllowFiveSigmasOfTheNoise) {
  // Noise of 0.05 rad has differences of 0.05 sqrt(2): five of them and 0.1 rad are 0.45 rad.
  const auto noise = [](int x, int y) {
    return 0.05 * normal_from(hash(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)));
  };
  const auto smooth = smooth_along([&](int x, int y) {
    return 0.3 * x + (x > 30 ? 0.3 : 0.0) + (x > 60 ? 0.8 : 0.0) + (y == 7 ? 0.0 : noise(x, y));
  });
  EXPECT_EQ(smooth(30, 7), 1);
  EXPECT_EQ(smooth(60, 7), 0);
  int broken = 0;
  for (int y = 0; y < kJumpRows; ++y) {
    for (int x = 0; x < 30; ++x)
      broken += 1 - smooth(x, y);
  }
  EXPECT_EQ(broken, 0);
}

TEST(SmoothJumps, NeedBothPixelsAndNoNeighbors) {
  const auto smooth = smooth_along([](int x, int) {
    const bool measured = x < 20 || x == 30 || x == 31 || x > 40;
    return measured ? 0.5 * x : static_cast<double>(kMissing);
  });
  for (int x = 0; x + 1 < kJumpColumns; ++x) {
    const bool both = x < 19 || x == 30 || x > 40;
    EXPECT_EQ(smooth(x, 7), both ? 1 : 0) << x;
  }
}

}  // namespace
}  // namespace frangia
