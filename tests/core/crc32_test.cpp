#include <string>

#include <gtest/gtest.h>

#include "frangia/core/checksums.h"

namespace frangia {
namespace {

TEST(Crc32, EqualsThePublishedCheckValue) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc32(digits), 0xCBF43926U);
}

TEST(Crc32, OfNoBytesIsZero) {
  EXPECT_EQ(crc32({}), 0U);
}

}  // namespace
}  // namespace frangia
