#include <gtest/gtest.h>

#include "frangia/core/text.h"

namespace frangia {
namespace {

TEST(PercentText, DoesNotRoundToNothingOrAll) {
  EXPECT_EQ(percent_text(0.0), "0.00 %");
  EXPECT_EQ(percent_text(1e-6), "under 0.01 %");
  EXPECT_EQ(percent_text(0.1234), "12.34 %");
  EXPECT_EQ(percent_text(1.0 - 1e-6), "over 99.99 %");
  EXPECT_EQ(percent_text(1.0), "100.00 %");
}

}  // namespace
}  // namespace frangia
