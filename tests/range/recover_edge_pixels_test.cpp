#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/remove_mixed_pixels.h"

#include "range/flat_view.h"

namespace frangia {
namespace {

constexpr float kEdgeSigma_mm = 0.02F;

struct EdgeScene : FlatView {
  /// Columns of row 30 whose pixels are removed and recovered.
  [[nodiscard]] std::vector<int> edge_pixels() {
    const auto removed = remove_mixed_pixels(range, rays, status);
    std::vector<int> columns;
    for (const RangePixel& pixel : recover_edge_pixels(range, rays, removed)) {
      if (pixel.y == 30) columns.push_back(pixel.x);
    }
    return columns;
  }
};

/// The columns from 60 on are dark; the pixels of column 59 receive the share `lit` of their light.
EdgeScene silhouette(float lit) {
  EdgeScene scene;
  scene.set_columns(60, 80, kMissing);
  for (int y = 0; y < 60; ++y) {
    scene.range.sigma_mm(59, y) = kEdgeSigma_mm / std::sqrt(lit);
    for (int x = 60; x < 80; ++x)
      scene.status(x, y) = PixelStatus::Unmodulated;
  }
  return scene;
}

TEST(RecoverEdgePixels, RecoversAnOutermostPixelFullyOnThePart) {
  EXPECT_EQ(silhouette(1.0F).edge_pixels(), std::vector<int>{59});
}

TEST(RecoverEdgePixels, RejectsAnOutermostPixelHalfOnThePart) {
  EXPECT_TRUE(silhouette(0.5F).edge_pixels().empty());
}

TEST(RecoverEdgePixels, KeepsThePhase) {
  EdgeScene scene = silhouette(1.0F);
  scene.range.phase_rad = Image<float>(80, 60, 7.0F);
  const auto removed = remove_mixed_pixels(scene.range, scene.rays, scene.status);
  const auto recovered = recover_edge_pixels(scene.range, scene.rays, removed);
  ASSERT_FALSE(recovered.empty());
  for (const RangePixel& pixel : recovered)
    EXPECT_EQ(pixel.phase_rad, 7.0F);
}

TEST(RecoverEdgePixels, RecoversThePixelsOnBothSidesOfAMixedPixel) {
  EdgeScene scene;
  scene.set_columns(40, 41, 510.0F);
  scene.set_columns(41, 80, 530.0F);
  EXPECT_EQ(scene.edge_pixels(), (std::vector<int>{39, 41, 42}));
}

TEST(RecoverEdgePixels, RejectsThePixelBehindALowStep) {
  EdgeScene scene;  // 2 mm at pixels of 0.5 mm: not steeper than a slope may be
  scene.set_columns(41, 80, 502.0F);
  const auto edge_pixels = scene.edge_pixels();
  EXPECT_TRUE(std::find(edge_pixels.begin(), edge_pixels.end(), 40) != edge_pixels.end());
  EXPECT_TRUE(std::find(edge_pixels.begin(), edge_pixels.end(), 41) == edge_pixels.end());
}

TEST(RecoverEdgePixels, GoesNoDeeperThanDepthPx) {
  EdgeScene scene;
  scene.set_columns(41, 80, 530.0F);
  const RangeGrid all = scene.range;
  std::vector<RangePixel> removed;
  for (int x = 30; x <= 40; ++x) {
    for (int y = 0; y < 60; ++y) {
      removed.push_back({x, y, 500.0F, kEdgeSigma_mm});
      scene.range.depth_mm(x, y) = kMissing;
    }
  }
  EXPECT_EQ(recover_edge_pixels(scene.range, scene.rays, removed, {.depth_px = 0}).size(), 0U);
  EXPECT_EQ(recover_edge_pixels(scene.range, scene.rays, removed, {.depth_px = 2}).size(), 120U);
}

}  // namespace
}  // namespace frangia
