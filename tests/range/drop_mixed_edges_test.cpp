#include "frangia/range/drop_mixed_edges.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/rig/lens.h"

namespace frangia {
namespace {

const Lens kLens{.width_px = 80,
                 .height_px = 60,
                 .focal_px = {1000.0, 1000.0},
                 .principal_point_px = {39.5, 29.5}};

struct Scene {
  Image<Eigen::Vector2f> rays = rays_of(kLens);
  RangeGrid range{Image<float>(80, 60, 500.0F), Image<float>(80, 60, 0.02F)};
  Image<PixelFate> fate{80, 60, PixelFate::Measured};

  std::size_t drop() { return drop_mixed_edges(range, rays, fate, {.give_back_px = 3}); }
};

TEST(DropMixedEdges, KeepsEveryPointOfASlopedSurface) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x)
      scene.range.depth_mm(x, y) = 480.0F + 1.5F * static_cast<float>(x);  // 72 degrees
  }
  EXPECT_EQ(scene.drop(), 0U);
}

TEST(DropMixedEdges, KeepsACrease) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x)
      scene.range.depth_mm(x, y) = 480.0F + std::abs(static_cast<float>(x) - 40.0F);
  }
  EXPECT_EQ(scene.drop(), 0U);
}

TEST(DropMixedEdges, DropsThePixelsBetweenTwoSurfaces) {
  for (const float step_mm : {3.0F, 30.0F}) {
    Scene scene;
    for (int y = 0; y < 60; ++y) {
      for (int x = 41; x < 80; ++x)
        scene.range.depth_mm(x, y) = 500.0F + step_mm;
      scene.range.depth_mm(40, y) = 500.0F + 0.3F * step_mm;  // sees both
    }
    EXPECT_GT(scene.drop(), 0U);
    for (int y = 0; y < 60; ++y) {
      EXPECT_EQ(scene.fate(40, y), PixelFate::MixedEdge) << step_mm;
      EXPECT_TRUE(std::isnan(scene.range.depth_mm(40, y)));
      EXPECT_EQ(scene.fate(36, y), PixelFate::Measured);
      EXPECT_EQ(scene.fate(44, y), PixelFate::Measured);
    }
  }
}

/// Column 60 and what follows is dark; a pixel of column 59 has `lit` of its light.
Scene silhouette(float lit) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    scene.range.sigma_mm(59, y) = 0.02F / std::sqrt(lit);
    for (int x = 60; x < 80; ++x) {
      scene.range.depth_mm(x, y) = kMissing;
      scene.fate(x, y) = PixelFate::Unmodulated;
    }
  }
  return scene;
}

TEST(DropMixedEdges, DropsAnOutermostPixelThatSeesThePartWithHalfOfItsSquare) {
  Scene scene = silhouette(0.5F);
  EXPECT_GT(scene.drop(), 0U);
  EXPECT_EQ(scene.fate(59, 30), PixelFate::MixedEdge);
  EXPECT_EQ(scene.fate(58, 30), PixelFate::Measured);
}

TEST(DropMixedEdges, KeepsAnOutermostPixelThatSeesThePartWithAllOfItsSquare) {
  EXPECT_EQ(silhouette(1.0F).drop(), 0U);
}

TEST(DropMixedEdges, KeepsPixelsBesideAStepThatSeeOneSurface) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    scene.range.depth_mm(40, y) = 510.0F;  // sees both
    for (int x = 41; x < 80; ++x)
      scene.range.depth_mm(x, y) = 530.0F;
  }
  EXPECT_EQ(scene.drop(), 60U);
  EXPECT_EQ(scene.fate(39, 30), PixelFate::Measured);
  EXPECT_EQ(scene.fate(40, 30), PixelFate::MixedEdge);
  EXPECT_EQ(scene.fate(41, 30), PixelFate::Measured);
}

TEST(DropMixedEdges, MindsNoSpeck) {
  Scene scene;
  scene.range.depth_mm(20, 20) = kMissing;
  scene.fate(20, 20) = PixelFate::Unmodulated;
  EXPECT_EQ(scene.drop(), 0U);
}

TEST(DropMixedEdges, DropsPatchesTooSmallToBeASurface) {
  Scene scene;
  for (float& depth : scene.range.depth_mm.pixels())
    depth = kMissing;
  for (int y = 20; y < 23; ++y) {
    for (int x = 20; x < 23; ++x)
      scene.range.depth_mm(x, y) = 500.0F;
  }
  EXPECT_EQ(scene.drop(), 9U);
}

}  // namespace
}  // namespace frangia
