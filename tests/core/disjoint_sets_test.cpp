#include "frangia/core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(DisjointSets, StartsWithOneSetPerNumber) {
  DisjointSets sets(3);
  for (std::uint32_t i = 0; i < 3; ++i)
    EXPECT_EQ(sets.find(i), i);
}

TEST(DisjointSets, TheSmallestMemberRepresentsASetForAnyOrderOfJoins) {
  DisjointSets up(6);
  up.join(1, 2);
  up.join(2, 5);
  DisjointSets down(6);
  down.join(5, 2);
  down.join(5, 1);
  for (const std::uint32_t i : {1U, 2U, 5U}) {
    EXPECT_EQ(up.find(i), 1U);
    EXPECT_EQ(down.find(i), 1U);
  }
  EXPECT_EQ(up.find(3), 3U);
}

}  // namespace
}  // namespace frangia
