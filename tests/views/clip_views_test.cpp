#include "frangia/views/clip_views.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"

#include "support/analytic_views.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using testing::small_camera_model;

ViewStore sphere_views() {
  return testing::snapshots(
      testing::sphere(40.0), small_camera_model(120, 600.0), testing::around_table(3, 0.3, 650.0));
}

/// Calls `look` with every point of every view, in the object frame.
template <typename Look>
void for_each_point(const ViewStore& views, const Look& look) {
  const auto rays = rays_of(small_camera_model(120, 600.0));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View view = views.load(i);
    for (int y = 0; y < rays.height(); ++y) {
      for (int x = 0; x < rays.width(); ++x) {
        const float depth = view.range.depth_mm(x, y);
        if (std::isnan(depth)) continue;
        const Eigen::Vector3f seen = depth * rays(x, y).homogeneous();
        look(view.rig_from_object.inverse() * seen.cast<double>());
      }
    }
  }
}

TEST(ClipViews, KeepsWhatIsAboveTheFloor) {
  ViewStore views = sphere_views();
  const auto removed = clip_views(
      views, small_camera_model(120, 600.0), {.floor = {Eigen::Vector3d::UnitZ(), -5.0}});
  EXPECT_GT(removed, 1000U);
  std::size_t left = 0;
  for_each_point(views, [&](const Eigen::Vector3d& point) {
    EXPECT_GT(point.z(), 5.0);
    ++left;
  });
  EXPECT_GT(left, 1000U);
}

TEST(ClipViews, KeepsWhatIsNearTheAxis) {
  ViewStore views = sphere_views();
  static_cast<void>(clip_views(views, small_camera_model(120, 600.0), {.max_radius_mm = 30.0}));
  for_each_point(views,
                 [](const Eigen::Vector3d& point) { EXPECT_LT(point.head<2>().norm(), 30.0); });
}

TEST(ClipViews, RemovesEdgePixelsLikeTheOthers) {
  ViewStore views = sphere_views();
  View view = views.load(0);
  const float depth_mm = view.range.depth_mm(60, 60);
  ASSERT_GT(depth_mm, 0.0F);
  view.edge_pixels = {{60, 60, depth_mm, 0.1F},
                      {60, 60, depth_mm + 300.0F, 0.1F}};  // inside and behind
  ViewStore one;
  one.add(view);
  static_cast<void>(clip_views(one, small_camera_model(120, 600.0), {.max_radius_mm = 100.0}));
  ASSERT_EQ(one.load(0).edge_pixels.size(), 1U);
  EXPECT_EQ(one.load(0).edge_pixels[0].depth_mm, depth_mm);
}

TEST(ClipViews, RemovesSigmaAndPhaseWithThePoint) {
  ViewStore all = sphere_views();
  View view = all.load(0);
  view.range.phase_rad = Image<float>(120, 120, 7.0F);
  ViewStore views;
  views.add(view);
  EXPECT_GT(clip_views(views, small_camera_model(120, 600.0), {.max_radius_mm = 30.0}), 0U);
  const RangeGrid clipped = views.load(0).range;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x) {
      const bool was_measured = !std::isnan(view.range.depth_mm(x, y));
      if (!was_measured) continue;
      EXPECT_EQ(std::isnan(clipped.sigma_mm(x, y)), std::isnan(clipped.depth_mm(x, y)));
      EXPECT_EQ(std::isnan(clipped.phase_rad(x, y)), std::isnan(clipped.depth_mm(x, y)));
    }
  }
}

TEST(ClipViews, CountsEveryPointThatItRemoves) {
  ViewStore all = sphere_views();
  View view = all.load(0);
  view.edge_pixels = {{60, 60, view.range.depth_mm(60, 60) + 300.0F, 0.1F}};
  ViewStore views;
  views.add(view);
  const auto count = [&] {
    std::size_t points = views.load(0).edge_pixels.size();
    for_each_point(views, [&](const Eigen::Vector3d&) { ++points; });
    return points;
  };
  const std::size_t before = count();
  const std::size_t removed =
      clip_views(views, small_camera_model(120, 600.0), {.max_radius_mm = 30.0});
  EXPECT_EQ(removed, before - count());
  EXPECT_GT(count(), 0U);
}

TEST(ClipViews, AcceptsThatOnePointIsLeft) {
  ViewStore all = sphere_views();
  View view = all.load(0);
  const float depth_mm = view.range.depth_mm(60, 60);
  view.range.depth_mm = Image<float>(120, 120, kMissing);
  view.range.depth_mm(60, 60) = depth_mm;
  ViewStore views;
  views.add(view);
  EXPECT_EQ(clip_views(views, small_camera_model(120, 600.0), {.max_radius_mm = 100.0}), 0U);
}

TEST(ClipViews, KeepsAllWithoutALimit) {
  ViewStore views = sphere_views();
  EXPECT_EQ(clip_views(views, small_camera_model(120, 600.0), {}), 0U);
}

TEST(ClipViews, RefusesToRemoveEverything) {
  ViewStore views = sphere_views();
  const std::string message = testing::error_of([&] {
    clip_views(
        views, small_camera_model(120, 600.0), {.floor = {Eigen::Vector3d::UnitZ(), -100.0}});
  });
  EXPECT_NE(message.find("`clip_below`"), std::string::npos) << message;
}

}  // namespace
}  // namespace frangia
