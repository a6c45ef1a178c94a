#include "frangia/fusion/internal/block_index.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(BlockIndex, FindsEachOfManyBlocksAndNoOther) {
  BlockIndex index;
  EXPECT_EQ(index.find(block_key(0, 0, 0)), BlockIndex::kNone);
  constexpr int kHalf = 12;
  std::uint32_t number = 0;
  for (int z = -kHalf; z < kHalf; ++z) {
    for (int y = -kHalf; y < kHalf; ++y) {
      for (int x = -kHalf; x < kHalf; ++x) {
        if ((x + y + z) % 2 == 0) index.add(block_key(x, y, z), number++);
      }
    }
  }
  number = 0;
  for (int z = -kHalf; z < kHalf; ++z) {
    for (int y = -kHalf; y < kHalf; ++y) {
      for (int x = -kHalf; x < kHalf; ++x) {
        const std::uint32_t wanted = (x + y + z) % 2 == 0 ? number++ : BlockIndex::kNone;
        ASSERT_EQ(index.find(block_key(x, y, z)), wanted) << x << " " << y << " " << z;
      }
    }
  }
}

TEST(BlockKey, IsUniqueForEachPosition) {
  constexpr int kFarthest = 1 << 20;
  EXPECT_NE(block_key(1, 0, 0), block_key(0, 1, 0));
  EXPECT_NE(block_key(0, 1, 0), block_key(0, 0, 1));
  EXPECT_NE(block_key(kFarthest - 1, 0, 0), block_key(-kFarthest, 1, 0));
}

}  // namespace
}  // namespace frangia
