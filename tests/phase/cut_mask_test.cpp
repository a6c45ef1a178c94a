#include "frangia/phase/spatial/internal/cut_mask.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

struct Steps {
  Image<float> phase{20, 14, 0.5F};
  Image<std::uint8_t> right{20, 14, 1};
  Image<std::uint8_t> below{20, 14, 1};

  [[nodiscard]] Image<std::uint8_t> near_cuts(int radius) const {
    return mark_near_cuts(phase, {right, below}, radius);
  }
};

/// Expects 1 exactly within the radius of one of two neighbouring pixels.
void expect_square(const Image<std::uint8_t>& mask, int x0, int y0, int x1, int y1, int radius) {
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const bool near = std::max(std::abs(x - x0), std::abs(y - y0)) <= radius ||
                        std::max(std::abs(x - x1), std::abs(y - y1)) <= radius;
      EXPECT_EQ(mask(x, y), near ? 1 : 0) << x << " " << y;
    }
  }
}

TEST(MarkNearCuts, MarksTheSquaresAroundBothPixelsOfACut) {
  for (const int radius : {0, 1, 3}) {
    Steps across;
    across.right(9, 6) = 0;
    expect_square(across.near_cuts(radius), 9, 6, 10, 6, radius);
    Steps down;
    down.below(9, 6) = 0;
    expect_square(down.near_cuts(radius), 9, 6, 9, 7, radius);
  }
}

TEST(MarkNearCuts, ReachesTheEdgesOfTheImage) {
  Steps corner;
  corner.right(0, 0) = 0;
  expect_square(corner.near_cuts(2), 0, 0, 1, 0, 2);
  Steps other;
  other.right(18, 13) = 0;
  expect_square(other.near_cuts(2), 18, 13, 19, 13, 2);
  Steps bottom;
  bottom.below(19, 12) = 0;
  expect_square(bottom.near_cuts(1), 19, 12, 19, 13, 1);
}

TEST(MarkNearCuts, IsNoCutWhereAPixelIsMissing) {
  Steps steps;
  steps.phase(10, 6) = kMissing;
  steps.right(9, 6) = steps.right(10, 6) = steps.below(10, 5) = steps.below(10, 6) = 0;
  const Image<std::uint8_t> mask = steps.near_cuts(2);
  EXPECT_EQ(std::count(mask.pixels().begin(), mask.pixels().end(), 1), 0);
}

TEST(MarkNearCuts, JoinsCutsThatAreNearEachOther) {
  Steps steps;
  steps.right(4, 6) = steps.right(8, 6) = 0;
  const Image<std::uint8_t> mask = steps.near_cuts(2);
  for (int x = 0; x < 20; ++x)
    EXPECT_EQ(mask(x, 8), x >= 2 && x <= 11 ? 1 : 0) << x;
}

}  // namespace
}  // namespace frangia
