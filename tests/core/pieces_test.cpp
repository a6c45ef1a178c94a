#include "frangia/core/pieces.h"

#include <array>

#include <gtest/gtest.h>

namespace frangia {
namespace {

using Triple = std::array<double, 3>;  // 24 bytes: no power of two

TEST(Pieces, KeepWhatWasWrittenOverSeveralPieces) {
  constexpr std::size_t kCount = 500'000;  // 12 MB
  Pieces<Triple> values(kCount);
  ASSERT_EQ(values.size(), kCount);
  for (std::size_t i = 0; i < kCount; ++i)
    values[i] = {static_cast<double>(i), 0.0, -static_cast<double>(i)};
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_EQ(values[i][2], -static_cast<double>(i));
}

TEST(Pieces, StayWhereTheyAreWhileOthersAreAdded) {
  Pieces<Triple> values;
  EXPECT_TRUE(values.empty());
  values.add();
  values[0] = {1.0, 2.0, 3.0};
  const Triple* first = &values[0];
  for (int i = 1; i < 400'000; ++i)
    values.add();
  EXPECT_EQ(values.size(), 400'000U);
  EXPECT_EQ(&values[0], first);
  EXPECT_EQ(values[0][1], 2.0);
}

}  // namespace
}  // namespace frangia
