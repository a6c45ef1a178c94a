#include "frangia/range/remove_mixed_pixels.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

#include "range/flat_view.h"

namespace frangia {
namespace {

struct Scene : FlatView {
  std::size_t removed() { return remove_mixed_pixels(range, rays, status).size(); }
};

TEST(RemoveMixedPixels, KeepsEveryPointOfASlopedSurface) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x)
      scene.range.depth_mm(x, y) = 480.0F + 1.5F * static_cast<float>(x);  // 72 degrees
  }
  EXPECT_EQ(scene.removed(), 0U);
}

TEST(RemoveMixedPixels, KeepsACrease) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x)
      scene.range.depth_mm(x, y) = 480.0F + std::abs(static_cast<float>(x) - 40.0F);
  }
  EXPECT_EQ(scene.removed(), 0U);
}

TEST(RemoveMixedPixels, RemovesThePixelsBetweenTwoSurfaces) {
  for (const float step_mm : {3.0F, 30.0F}) {
    Scene scene;
    for (int y = 0; y < 60; ++y) {
      for (int x = 41; x < 80; ++x)
        scene.range.depth_mm(x, y) = 500.0F + step_mm;
      scene.range.depth_mm(40, y) = 500.0F + 0.3F * step_mm;  // sees both
    }
    EXPECT_GT(scene.removed(), 0U);
    for (int y = 0; y < 60; ++y) {
      EXPECT_EQ(scene.status(40, y), PixelStatus::MixedPixel) << step_mm;
      EXPECT_TRUE(std::isnan(scene.range.depth_mm(40, y)));
      EXPECT_EQ(scene.status(36, y), PixelStatus::Measured);
      EXPECT_EQ(scene.status(44, y), PixelStatus::Measured);
    }
  }
}

TEST(RemoveMixedPixels, ReachesAsFarAsTheBlurOfTheImage) {
  struct Case {
    double blur_px;
    int at_step_px;        // pixels beside a step that get more than 1 % of their light across it
    int at_silhouette_px;  // pixels that a dark background takes more than 5 % of their light
  };
  for (const Case& one : {Case{0.0, 2, 1}, Case{0.5, 2, 1}, Case{1.0, 2, 2}, Case{1.2, 3, 2}}) {
    Scene scene;
    scene.set_columns(40, 80, 530.0F);
    scene.set_columns(60, 80, kMissing);
    for (int y = 0; y < 60; ++y)
      std::fill_n(&scene.status(60, y), 20, PixelStatus::Unmodulated);
    remove_mixed_pixels(scene.range, scene.rays, scene.status, {.blur_px = one.blur_px});
    for (int x = 30; x < 60; ++x) {
      const int from_step = x < 40 ? 40 - x : x - 39;
      const bool is_mixed = from_step <= one.at_step_px || 60 - x <= one.at_silhouette_px;
      EXPECT_EQ(scene.status(x, 30) == PixelStatus::MixedPixel, is_mixed)
          << one.blur_px << " px, column " << x;
    }
  }
}

TEST(RemoveMixedPixels, FindsAStepWhosePixelsOfABlurredImageHaveNoDepth) {
  for (const double blur_px : {0.0, 1.0}) {
    Scene scene;
    scene.set_columns(40, 80, 530.0F);
    scene.set_columns(39, 40, kMissing);  // the mixed light has too little modulation
    remove_mixed_pixels(scene.range, scene.rays, scene.status, {.blur_px = blur_px});
    EXPECT_EQ(scene.status(38, 30) == PixelStatus::MixedPixel, blur_px > 0.0);
    EXPECT_EQ(scene.status(40, 30) == PixelStatus::MixedPixel, blur_px > 0.0);
    EXPECT_EQ(scene.status(37, 30), PixelStatus::Measured);
  }
}

TEST(RemoveMixedPixels, RemovesTheOutermostPixelOfASilhouetteButNotAtASpeck) {
  Scene scene;
  for (int y = 0; y < 60; ++y) {
    for (int x = 60; x < 80; ++x) {
      scene.range.depth_mm(x, y) = kMissing;
      scene.status(x, y) = PixelStatus::Unmodulated;
    }
  }
  scene.range.depth_mm(20, 20) = kMissing;
  scene.status(20, 20) = PixelStatus::Unmodulated;
  scene.removed();
  EXPECT_EQ(scene.status(59, 30), PixelStatus::MixedPixel);
  EXPECT_EQ(scene.status(58, 30), PixelStatus::Measured);
  EXPECT_EQ(scene.status(21, 20), PixelStatus::Measured);
}

TEST(RemoveMixedPixels, RemovesPatchesTooSmallToBeASurface) {
  Scene scene;
  for (float& depth : scene.range.depth_mm.pixels())
    depth = kMissing;
  for (int y = 20; y < 23; ++y) {
    for (int x = 20; x < 23; ++x)
      scene.range.depth_mm(x, y) = 500.0F;
  }
  EXPECT_EQ(scene.removed(), 9U);
}

TEST(RemoveMixedPixels, ReturnsTheRemovedPixelsWithTheirPhase) {
  Scene scene;
  scene.range.phase_rad = Image<float>(80, 60, 7.0F);
  scene.set_columns(40, 80, 530.0F);
  const auto removed = remove_mixed_pixels(scene.range, scene.rays, scene.status);
  ASSERT_FALSE(removed.empty());
  for (const RangePixel& pixel : removed) {
    EXPECT_EQ(pixel.phase_rad, 7.0F);
    EXPECT_TRUE(std::isnan(scene.range.phase_rad(pixel.x, pixel.y)));
  }
  EXPECT_EQ(scene.range.phase_rad(20, 20), 7.0F);
}

TEST(RemoveMixedPixels, TakesTheMinimumStepFromItsOptions) {
  for (const double min_step_px : {2.5, 8.0}) {
    Scene scene;  // 3 mm at pixels of 0.5 mm
    scene.set_columns(40, 80, 503.0F);
    const MixedPixelOptions options{.min_step_px = min_step_px};
    const auto removed = remove_mixed_pixels(scene.range, scene.rays, scene.status, options);
    EXPECT_EQ(removed.empty(), min_step_px == 8.0);
  }
}

}  // namespace
}  // namespace frangia
