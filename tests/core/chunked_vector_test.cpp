#include "frangia/core/chunked_vector.h"

#include <array>

#include <gtest/gtest.h>

namespace frangia {
namespace {

using Triple = std::array<double, 3>;  // 24 bytes, not a power of two

TEST(ChunkedVector, KeepsValuesAcrossChunks) {
  constexpr std::size_t kCount = 500'000;  // 12 MB
  ChunkedVector<Triple> values(kCount);
  ASSERT_EQ(values.size(), kCount);
  for (std::size_t i = 0; i < kCount; ++i)
    values[i] = {static_cast<double>(i), 0.0, -static_cast<double>(i)};
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_EQ(values[i][2], -static_cast<double>(i));
}

TEST(ChunkedVector, KeepsAddressesWhileGrowing) {
  ChunkedVector<Triple> values;
  EXPECT_TRUE(values.empty());
  values.append_uninitialized();
  values[0] = {1.0, 2.0, 3.0};
  const Triple* first = &values[0];
  for (int i = 1; i < 400'000; ++i)
    values.append_uninitialized();
  EXPECT_EQ(values.size(), 400'000U);
  EXPECT_EQ(&values[0], first);
  EXPECT_EQ(values[0][1], 2.0);
}

}  // namespace
}  // namespace frangia
