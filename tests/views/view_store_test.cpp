#include "frangia/views/view_store.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"

#include "support/error_of.h"

namespace frangia {
namespace {

View view_of(float value, int width = 30, int height = 20) {
  View view;
  view.range = {Image<float>(width, height, value), Image<float>(width, height, 0.1F * value)};
  view.range.depth_mm(3, 4) = kMissing;
  view.rig_from_object.translation() = Eigen::Vector3d(value, 0.0, 0.0);
  return view;
}

TEST(ViewStore, ReturnsWhatWasAdded) {
  ViewStore store;
  store.add(view_of(1.0F));
  store.add(view_of(2.0F, 11, 7));
  ASSERT_EQ(store.size(), 2U);
  const View second = store.load(1);
  EXPECT_EQ(second.range.depth_mm.width(), 11);
  EXPECT_EQ(second.range.depth_mm(0, 0), 2.0F);
  EXPECT_TRUE(std::isnan(second.range.depth_mm(3, 4)));
  EXPECT_EQ(store.load(0).range.sigma_mm(5, 5), 0.1F);
  EXPECT_EQ(store.rig_from_object(1).translation().x(), 2.0);
}

TEST(ViewStore, ReplacesOneViewAndLeavesTheOthers) {
  ViewStore store;
  store.add(view_of(1.0F));
  store.add(view_of(2.0F));
  store.replace(0, view_of(7.0F));
  EXPECT_EQ(store.load(0).range.depth_mm(0, 0), 7.0F);
  EXPECT_EQ(store.load(1).range.depth_mm(0, 0), 2.0F);
  EXPECT_THROW(store.replace(1, view_of(1.0F, 5, 5)), Error);
}

TEST(ViewStore, LoadsTheSystematicPartWhereItIsAskedFor) {
  ViewStore store;
  View view = view_of(1.0F);
  view.range.phase_rad = Image<float>(30, 20, 5.0F);
  view.range.systematic_mm = Image<float>(30, 20, 0.25F);
  view.range.systematic_mm(7, 6) = 0.5F;
  view.range.differing_share = 0.75F;
  store.add(view_of(2.0F));
  EXPECT_FALSE(store.has_systematic());
  store.add(view);
  EXPECT_TRUE(store.has_systematic());
  EXPECT_EQ(store.load(1).range.systematic_mm(7, 6), 0.5F);
  EXPECT_EQ(store.load(1).range.phase_rad(7, 6), 5.0F);
  EXPECT_EQ(store.load(1).range.differing_share, 0.75F);
  EXPECT_EQ(store.load(0).range.differing_share, 0.0F);
  EXPECT_EQ(store.load_points(1, PointSigma::BothParts).range.systematic_mm(7, 6), 0.5F);
  EXPECT_TRUE(store.load_points(1, PointSigma::BothParts).range.phase_rad.empty());
  EXPECT_TRUE(store.load_points(1).range.systematic_mm.empty());
  EXPECT_TRUE(store.load_colored_points(1).range.systematic_mm.empty());
  EXPECT_TRUE(store.load_colored_points(1).range.phase_rad.empty());
  EXPECT_TRUE(store.load(0).range.systematic_mm.empty());
  EXPECT_THROW(store.replace(1, view_of(1.0F)), Error);
}

TEST(ViewStore, KeepsEdgePixelsBehindTheSystematicPart) {
  ViewStore store;
  View view = view_of(1.0F);
  view.range.systematic_mm = Image<float>(30, 20, 0.25F);
  view.edge_pixels = {{3, 4, 5.0F, 0.5F, kMissing, 0.75F}};
  store.add(view);
  for (const PointSigma sigma : {PointSigma::Noise, PointSigma::BothParts}) {
    View loaded = store.load_points(0, sigma);
    ASSERT_EQ(loaded.edge_pixels.size(), 1U);
    EXPECT_EQ(loaded.edge_pixels[0].systematic_mm, 0.75F);
    for (const RangePixel& pixel : loaded.edge_pixels)
      loaded.range.set(pixel);
    EXPECT_EQ(loaded.range.depth_mm(3, 4), 5.0F);
  }
}

TEST(ViewStore, KeepsEdgePixelsApartFromTheGrid) {
  ViewStore store;
  View view = view_of(1.0F);
  view.edge_pixels = {{3, 4, 5.0F, 0.5F}};
  store.add(view);
  const View loaded = store.load(0);
  EXPECT_TRUE(std::isnan(loaded.range.depth_mm(3, 4)));
  ASSERT_EQ(loaded.edge_pixels.size(), 1U);
  EXPECT_EQ(loaded.edge_pixels[0].depth_mm, 5.0F);
  EXPECT_EQ(loaded.edge_pixels[0].x, 3);
  store.add(view_of(2.0F));
  store.clear(0);
  EXPECT_TRUE(store.load(0).edge_pixels.empty());
  EXPECT_EQ(store.load(1).range.depth_mm(0, 0), 2.0F);
  EXPECT_THROW(store.replace(1, view), Error);  // more edge pixels than before
}

TEST(ViewStore, KeepsThePhaseBetweenGridAndEdgePixels) {
  ViewStore store;
  View view = view_of(1.0F);
  view.range.phase_rad = Image<float>(30, 20, 7.0F);
  view.edge_pixels = {{3, 4, 5.0F, 0.5F, 9.0F}};
  store.add(view);
  store.add(view_of(2.0F));  // without phase
  const View loaded = store.load(0);
  EXPECT_EQ(loaded.range.phase_rad(29, 19), 7.0F);
  EXPECT_EQ(loaded.edge_pixels.at(0).phase_rad, 9.0F);
  EXPECT_TRUE(store.load(1).range.phase_rad.empty());
  EXPECT_EQ(store.load(1).range.depth_mm(0, 0), 2.0F);
  store.clear(0);
  EXPECT_TRUE(std::isnan(store.load(0).range.phase_rad(5, 5)));
}

TEST(ViewStore, LoadsPointsWithoutPhase) {
  ViewStore store;
  View view = view_of(1.0F);
  view.range.phase_rad = Image<float>(30, 20, 7.0F);
  view.edge_pixels = {{3, 4, 5.0F, 0.5F, 9.0F}};
  store.add(view);
  const View points = store.load_points(0);
  EXPECT_TRUE(points.range.phase_rad.empty());
  EXPECT_EQ(points.range.sigma_mm(5, 5), 0.1F);
  EXPECT_EQ(points.edge_pixels.at(0).depth_mm, 5.0F);
  EXPECT_EQ(store.load_depth_mm(0)(29, 19), 1.0F);
  EXPECT_THROW(store.replace(0, points), Error);  // the phase would be lost
  EXPECT_EQ(store.load(0).range.phase_rad(5, 5), 7.0F);
}

/// 30 x 20 pixels, of which those of a box are measured.
View view_of_box(const PixelBox& box) {
  View view;
  for (Image<float>* image : {&view.range.depth_mm, &view.range.sigma_mm, &view.range.phase_rad}) {
    *image = Image<float>(30, 20, kMissing);
    for (int y = box.top; y < box.bottom; ++y) {
      for (int x = box.left; x < box.right; ++x)
        (*image)(x, y) = static_cast<float>(100 * y + x);
    }
  }
  return view;
}

void expect_same(const Image<float>& a, const Image<float>& b) {
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    EXPECT_TRUE(a.pixels()[i] == b.pixels()[i] ||
                (std::isnan(a.pixels()[i]) && std::isnan(b.pixels()[i])))
        << i;
  }
}

TEST(ViewStore, ReturnsTheMissingPixelsAroundAPart) {
  ViewStore store;
  for (const PixelBox& box :
       {PixelBox{4, 3, 17, 9}, {0, 0, 30, 20}, {29, 19, 30, 20}, {0, 0, 0, 0}})
    store.add(view_of_box(box));
  expect_same(store.load(0).range.depth_mm, view_of_box({4, 3, 17, 9}).range.depth_mm);
  expect_same(store.load(0).range.phase_rad, view_of_box({4, 3, 17, 9}).range.phase_rad);
  expect_same(store.load_points(1).range.sigma_mm, view_of_box({0, 0, 30, 20}).range.sigma_mm);
  expect_same(store.load_depth_mm(2), view_of_box({29, 19, 30, 20}).range.depth_mm);
  expect_same(store.load(3).range.depth_mm, view_of_box({0, 0, 0, 0}).range.depth_mm);
}

TEST(ViewStore, HoldsAViewWhosePartGrows) {
  ViewStore store;
  store.add(view_of_box({4, 3, 5, 4}));
  store.add(view_of_box({1, 1, 9, 9}));
  store.replace(0, view_of_box({2, 2, 28, 18}));
  expect_same(store.load(0).range.phase_rad, view_of_box({2, 2, 28, 18}).range.phase_rad);
  expect_same(store.load(1).range.phase_rad, view_of_box({1, 1, 9, 9}).range.phase_rad);
}

TEST(ViewStore, KeepsTheRaysOfTheLastCamera) {
  const ViewStore store;
  CameraModel camera{.width_px = 30,
                     .height_px = 20,
                     .focal_px = {100.0, 100.0},
                     .principal_point_px = {15.0, 10.0}};
  const auto first = store.rays(camera);
  EXPECT_EQ((*first)(25, 10), Eigen::Vector2f(0.1F, 0.0F));
  EXPECT_EQ(store.rays(camera), first);
  camera.focal_px.x() = 50.0;
  EXPECT_EQ((*store.rays(camera))(25, 10), Eigen::Vector2f(0.2F, 0.0F));
}

TEST(ViewStore, NamesTheTemporaryFolderThatCannotHoldIt) {
  const char* before = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): no other thread
  const std::string folder = before != nullptr ? before : "/tmp";
  ::setenv("TMPDIR", "/nowhere", 1);  // NOLINT(concurrency-mt-unsafe)
  const std::string message = testing::error_of([] { const ViewStore store; });
  ::setenv("TMPDIR", folder.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  EXPECT_NE(message.find("/nowhere"), std::string::npos) << message;
}

TEST(ViewStore, RefusesImagesOfDifferentSize) {
  ViewStore store;
  View view = view_of(1.0F);
  view.range.phase_rad = Image<float>(29, 20, 7.0F);
  EXPECT_THROW(store.add(view), Error);
}

TEST(ViewStore, KeepsItsViewsWhenMoved) {
  ViewStore store;
  store.add(view_of(3.0F));
  const ViewStore moved = std::move(store);
  EXPECT_EQ(moved.load(0).range.depth_mm(0, 0), 3.0F);
}

}  // namespace
}  // namespace frangia
