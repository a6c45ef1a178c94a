#include "frangia/views/add_edge_pixels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

TEST(AddEdgePixels, PutsThePixelsWhereTheyBelong) {
  View view{
      {Image<float>(4, 3, kMissing), Image<float>(4, 3, kMissing)}, {}, {{2, 1, 500.0F, 0.1F}}};
  add_edge_pixels(view);
  EXPECT_EQ(view.range.depth_mm(2, 1), 500.0F);
  EXPECT_EQ(view.range.sigma_mm(2, 1), 0.1F);
  EXPECT_TRUE(std::isnan(view.range.depth_mm(1, 1)));
  EXPECT_TRUE(view.edge_pixels.empty());
}

}  // namespace
}  // namespace frangia
