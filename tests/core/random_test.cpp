#include "frangia/core/random.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(Random, NormalNumbersHaveMeanZeroAndVarianceOne) {
  constexpr std::uint64_t kCount = 200000;
  double sum = 0.0;
  double sum2 = 0.0;
  double sum4 = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double x = normal_from(hash(7, i));
    sum += x;
    sum2 += x * x;
    sum4 += x * x * x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(sum2 / kCount, 1.0, 0.015);
  EXPECT_NEAR(sum4 / kCount, 3.0, 0.15);
}

TEST(Random, NeighboringIndicesAreNotCorrelated) {
  constexpr std::uint64_t kCount = 200000;
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i)
    sum += normal_from(hash(7, i)) * normal_from(hash(7, i + 1));
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
}

}  // namespace
}  // namespace frangia
