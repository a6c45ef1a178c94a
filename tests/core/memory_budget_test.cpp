#include "frangia/core/memory_budget.h"

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(MemoryBudget, NamesTheSizeThatIsNeeded) {
  const MemoryBudget budget("a.glb", 900'000, kAllowMemoryBytes);
  EXPECT_EQ(error_of([&] { budget.check(1.99e9); }), "");
  EXPECT_EQ(error_of([&] { budget.check(2.1e9, 19.55e9); }),
            "a.glb: its 900 kB expand to 19.6 GB of memory, more than the 2 GB that are allowed; "
            "set `allow_memory` to 19.6GB to read it");
  EXPECT_EQ(error_of([&] { MemoryBudget("a.glb", 900'000, 19'600'000'000).check(19.6e9); }), "");
}

TEST(MemoryBudget, GrowsWithALargeFile) {
  EXPECT_EQ(error_of([&] { MemoryBudget("a.glb", 50'000'000, kAllowMemoryBytes).check(10e9); }),
            "");
  EXPECT_NE(error_of([&] { MemoryBudget("a.glb", 50'000'000, kAllowMemoryBytes).check(11e9); }),
            "");
}

TEST(MemoryBudget, WordsSizesRoundedUp) {
  EXPECT_EQ(size_text(203), "203 bytes");
  EXPECT_EQ(size_text(50'100), "51 kB");
  EXPECT_EQ(size_text(2e9), "2 GB");
  EXPECT_EQ(size_text(1e300), "over 1000 TB");
}

}  // namespace
}  // namespace frangia
