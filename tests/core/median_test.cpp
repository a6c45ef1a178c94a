#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/statistics.h"

namespace frangia {
namespace {

TEST(Median, IsTheMiddleValueOfAnOddCount) {
  EXPECT_EQ(median(std::vector<double>{9.0, 1.0, 5.0}), 5.0);
}

TEST(Median, IsTheUpperMiddleValueOfAnEvenCount) {
  EXPECT_EQ(median(std::vector<float>{4.0F, 1.0F, 3.0F, 2.0F}), 3.0F);
  EXPECT_EQ(median(std::vector<int>{1, 2}), 2);
}

TEST(Median, OfNoValuesIsZero) {
  EXPECT_EQ(median(std::vector<double>{}), 0.0);
}

TEST(Median, KeepsTheOrderOfTheCallersValues) {
  const std::vector<int> values{3, 1, 2, 5, 4};
  EXPECT_EQ(median(values), 3);
  EXPECT_EQ(values, (std::vector<int>{3, 1, 2, 5, 4}));
}

TEST(Median, InPlaceEqualsTheSortedMiddle) {
  std::vector<double> values;
  for (int i = 0; i < 101; ++i)
    values.push_back((i * 37) % 101);
  EXPECT_EQ(median_in_place(std::span<double>(values)), 50.0);
}

}  // namespace
}  // namespace frangia
