#include "frangia/views/add_rim.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

TEST(AddRim, PutsThePixelsWhereTheyBelong) {
  View view{
      {Image<float>(4, 3, kMissing), Image<float>(4, 3, kMissing)}, {}, {{2, 1, 500.0F, 0.1F}}};
  add_rim(view);
  EXPECT_EQ(view.range.depth_mm(2, 1), 500.0F);
  EXPECT_EQ(view.range.sigma_mm(2, 1), 0.1F);
  EXPECT_TRUE(std::isnan(view.range.depth_mm(1, 1)));
  EXPECT_TRUE(view.rim.empty());
}

}  // namespace
}  // namespace frangia
