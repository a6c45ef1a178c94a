#include "frangia/range/drop_mixed_edges.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

#include "range/flat_view.h"

namespace frangia {
namespace {

struct Scene : FlatView {
  std::size_t drop() { return drop_mixed_edges(range, rays, fate).size(); }
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

TEST(DropMixedEdges, DropsTheOutermostPixelOfASilhouetteAndMindsNoSpeck) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    for (int x = 60; x < 80; ++x) {
      scene.range.depth_mm(x, y) = kMissing;
      scene.fate(x, y) = PixelFate::Unmodulated;
    }
  }
  scene.range.depth_mm(20, 20) = kMissing;
  scene.fate(20, 20) = PixelFate::Unmodulated;
  scene.drop();
  EXPECT_EQ(scene.fate(59, 30), PixelFate::MixedEdge);
  EXPECT_EQ(scene.fate(58, 30), PixelFate::Measured);
  EXPECT_EQ(scene.fate(21, 20), PixelFate::Measured);
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
