#include "frangia/views/add_edge_pixels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

TEST(AddEdgePixels, MovesThePixelsIntoTheGrid) {
  const Image<float> missing(4, 3, kMissing);
  View view{{missing, missing, missing}, {}, {{2, 1, 500.0F, 0.1F, 7.0F}}};
  add_edge_pixels(view);
  EXPECT_EQ(view.range.phase_rad(2, 1), 7.0F);
  EXPECT_TRUE(std::isnan(view.range.phase_rad(1, 1)));
  EXPECT_EQ(view.range.depth_mm(2, 1), 500.0F);
  EXPECT_EQ(view.range.sigma_mm(2, 1), 0.1F);
  EXPECT_TRUE(std::isnan(view.range.depth_mm(1, 1)));
  EXPECT_TRUE(view.edge_pixels.empty());
}

TEST(AddEdgePixels, NeedsNoPhase) {
  const Image<float> missing(4, 3, kMissing);
  View view{{missing, missing}, {}, {{2, 1, 500.0F, 0.1F}}};
  add_edge_pixels(view);
  EXPECT_EQ(view.range.depth_mm(2, 1), 500.0F);
  EXPECT_TRUE(view.range.phase_rad.empty());
}

}  // namespace
}  // namespace frangia
