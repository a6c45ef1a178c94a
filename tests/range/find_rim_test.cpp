#include "frangia/range/find_rim.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/drop_mixed_edges.h"

#include "range/flat_view.h"

namespace frangia {
namespace {

constexpr float kEdgeSigma_mm = 0.02F;

struct EdgeScene : FlatView {
  /// Columns of row 30 whose pixels are dropped and given back.
  [[nodiscard]] std::vector<int> rim() {
    const auto dropped = drop_mixed_edges(range, rays, fate);
    std::vector<int> columns;
    for (const RangePixel& pixel : find_rim(range, rays, dropped)) {
      if (pixel.y == 30) columns.push_back(pixel.x);
    }
    return columns;
  }
};

/// Column 60 and what follows is dark; a pixel of column 59 has `lit` of its light.
EdgeScene silhouette(float lit) {
  EdgeScene scene;
  scene.set_columns(60, 80, kMissing);
  for (int y = 0; y < 60; ++y) {
    scene.range.sigma_mm(59, y) = kEdgeSigma_mm / std::sqrt(lit);
    for (int x = 60; x < 80; ++x)
      scene.fate(x, y) = PixelFate::Unmodulated;
  }
  return scene;
}

TEST(FindRim, GivesBackAnOutermostPixelThatSeesThePartWithAllOfItsSquare) {
  EXPECT_EQ(silhouette(1.0F).rim(), std::vector<int>{59});
}

TEST(FindRim, LeavesAnOutermostPixelThatSeesThePartWithHalfOfItsSquare) {
  EXPECT_TRUE(silhouette(0.5F).rim().empty());
}

TEST(FindRim, GivesBackThePixelsOnBothSidesOfOneThatSeesTwoSurfaces) {
  EdgeScene scene;
  scene.set_columns(40, 41, 510.0F);
  scene.set_columns(41, 80, 530.0F);
  EXPECT_EQ(scene.rim(), (std::vector<int>{39, 41, 42}));
}

TEST(FindRim, LeavesThePixelBehindALowStepThatWouldBeJoinedToTheOneBefore) {
  EdgeScene scene;  // 2 mm at pixels of 0.5 mm: no steeper than a slope may be
  scene.set_columns(41, 80, 502.0F);
  const auto rim = scene.rim();
  EXPECT_TRUE(std::find(rim.begin(), rim.end(), 40) != rim.end());
  EXPECT_TRUE(std::find(rim.begin(), rim.end(), 41) == rim.end());
}

TEST(FindRim, GoesNoDeeperThanItIsTold) {
  EdgeScene scene;
  scene.set_columns(41, 80, 530.0F);
  const RangeGrid all = scene.range;
  std::vector<RangePixel> dropped;
  for (int x = 30; x <= 40; ++x) {
    for (int y = 0; y < 60; ++y) {
      dropped.push_back({x, y, 500.0F, kEdgeSigma_mm});
      scene.range.depth_mm(x, y) = kMissing;
    }
  }
  EXPECT_EQ(find_rim(scene.range, scene.rays, dropped, {.depth_px = 0}).size(), 0U);
  EXPECT_EQ(find_rim(scene.range, scene.rays, dropped, {.depth_px = 2}).size(), 120U);
}

}  // namespace
}  // namespace frangia
