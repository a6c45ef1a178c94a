#include "frangia/phase/internal/jumpless_regions.h"

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

TEST(FindJumplessRegions, SeparatesAtHalfAFringeAndSortsBySize) {
  // Three stripes of 3, 9 and 4 columns; the last one touches the second along y only.
  Image<float> phase(16, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 16; ++x)
      phase(x, y) = 3.0F * static_cast<float>(x) + (x < 3 ? 0.0F : 0.5F) + (x < 12 ? 0.0F : 0.5F);
  }
  phase(5, 2) = kMissing;
  const JumplessRegions found = find_jumpless_regions(phase);
  ASSERT_EQ(found.size, (std::vector<std::size_t>{44, 20, 15}));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 16; ++x) {
      const int wanted = x == 5 && y == 2 ? -1 : x < 3 ? 2 : x < 12 ? 0 : 1;
      EXPECT_EQ(found.label[static_cast<std::size_t>(16 * y + x)], wanted) << x << " " << y;
    }
  }
}

TEST(FindJumplessRegions, GoesRoundWhatIsMissing) {
  Image<float> phase(7, 7, 1.0F);
  for (int y = 0; y < 6; ++y)
    phase(3, y) = kMissing;
  EXPECT_EQ(find_jumpless_regions(phase).size, std::vector<std::size_t>{43});
  phase(3, 6) = kMissing;
  EXPECT_EQ(find_jumpless_regions(phase).size, (std::vector<std::size_t>{21, 21}));
  const JumplessRegions none = find_jumpless_regions(Image<float>(3, 3, kMissing));
  EXPECT_TRUE(none.size.empty());
}

}  // namespace
}  // namespace frangia
