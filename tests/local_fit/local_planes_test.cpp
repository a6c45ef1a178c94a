#include "frangia/local_fit/local_planes.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::look_from;
using testing::small_camera_model;

constexpr double kStandOff = 650.0;

/// The signed distance of a point of the object frame to the surface that the view measured.
float in_front(const LocalPlanes& view, const CameraModel& model, const Eigen::Vector3d& point) {
  const Eigen::Vector3d seen = view.rig_from_object * point;
  const Eigen::Vector2f pixel = model.project(seen).cast<float>();
  const LocalPlanes::Quad* quad = view.quad_at(pixel.x(), pixel.y());
  if (quad == nullptr) return kMissing;
  if (quad->kind != LocalPlanes::Kind::Smooth) {
    return view.nearest_face(pixel.x(), pixel.y(), seen.cast<float>())
        .in_front_mm(seen.cast<float>());
  }
  return (1.0F - static_cast<float>(seen.z()) * view.inverse_depth_at(pixel.x(), pixel.y())) *
         quad->distance_mm;
}

TEST(LocalPlanes, MeasureTheDistanceFromAPlaneSeenObliquely) {
  const CameraRays camera(small_camera_model());
  const LocalPlanes view = local_planes(
      testing::snapshot(
          testing::floor_at(0.0), camera.model, look_from(0.4, 0.5, kStandOff), {.noise_mm = 0.0}),
      camera);
  for (const double height : {-1.0, 0.0, 0.7}) {
    EXPECT_NEAR(in_front(view, camera.model, {10.0, -20.0, height}), height, 2e-3);
  }
}

TEST(LocalPlanes, KeepBothFacesOfARidge) {
  const CameraRays camera(small_camera_model());
  const LocalPlanes view = local_planes(
      testing::snapshot(
          testing::box({20.0, 20.0, 20.0}), camera.model, look_from(0.6, 0.5, kStandOff)),
      camera);
  // On the edge between the faces x = 20 and y = 20, and next to it.
  EXPECT_NEAR(in_front(view, camera.model, {20.0, 20.0, 3.0}), 0.0, 0.05);
  EXPECT_NEAR(in_front(view, camera.model, {20.3, 20.0, 3.0}), 0.3, 0.06);
  EXPECT_NEAR(in_front(view, camera.model, {20.0, 20.3, 3.0}), 0.3, 0.06);
  EXPECT_NEAR(in_front(view, camera.model, {19.7, 19.7, 3.0}), -0.3, 0.06);
}

TEST(LocalPlanes, HaveNoQuadAcrossADepthStep) {
  const CameraRays camera(small_camera_model());
  const auto scene = testing::both(testing::sphere(12.0, {0.0, 0.0, 40.0}), testing::floor_at(0.0));
  const View view = testing::snapshot(scene, camera.model, look_from(0.0, 1.2, kStandOff));
  const LocalPlanes planes = local_planes(view, camera);
  for (int y = 0; y < planes.quads.height(); ++y) {
    for (int x = 0; x < planes.quads.width(); ++x) {
      if (planes.quads(x, y).kind == LocalPlanes::Kind::Unseen) continue;
      EXPECT_LT(std::abs(view.range.depth_mm(x, y) - view.range.depth_mm(x + 1, y + 1)), 10.0F);
    }
  }
}

TEST(LocalPlanes, AreLessNoisyWithWiderWindows) {
  const CameraRays camera(small_camera_model());
  const View view = testing::snapshot(testing::floor_at(0.0),
                                      camera.model,
                                      look_from(0.0, 1.2, kStandOff),
                                      {.noise_mm = 0.1, .sigma_mm = 0.1});
  const auto variance = [&](bool widen) {
    const LocalPlanes planes = local_planes(view, camera, {.widen = widen});
    const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
    double squares = 0.0;
    int count = 0;
    for (int y = 20; y < 280; ++y) {
      for (int x = 20; x < 280; ++x) {
        if (!planes.has_plane(x, y)) continue;
        const Eigen::Vector3d seen =
            (camera.rays(x, y).homogeneous() / planes.inverse_depth(x, y)).cast<double>();
        squares += std::pow((object_from_rig * seen).z(), 2);
        ++count;
      }
    }
    return squares / count;
  };
  const double ratio =
      static_cast<double>(value_variance(3)) / static_cast<double>(value_variance(2));
  EXPECT_NEAR(variance(true) / variance(false), ratio, 0.1);
}

bool are_equal(const LocalPlanes::Plane& a, const LocalPlanes::Plane& b) {
  return a.normal == b.normal && a.distance_mm == b.distance_mm && a.weight == b.weight &&
         a.tangent_distance_mm == b.tangent_distance_mm && a.window == b.window;
}

bool are_equal(const LocalPlanes::Quad& a, const LocalPlanes::Quad& b) {
  return a.distance_mm == b.distance_mm && a.weight == b.weight && a.kind == b.kind;
}

/// The number of pixels at multiples of `every` whose plane, quad or inverse depth differs.
int count_differences(const LocalPlanes& a, const LocalPlanes& b, int every = 1) {
  int differences = 0;
  for (int y = 0; y < a.quads.height(); y += every) {
    for (int x = 0; x < a.quads.width(); x += every) {
      const float q = a.inverse_depth(x, y);
      const bool same_depth =
          q == b.inverse_depth(x, y) || (std::isnan(q) && std::isnan(b.inverse_depth(x, y)));
      const bool same = same_depth && are_equal(a.planes(x, y), b.planes(x, y)) &&
                        are_equal(a.quads(x, y), b.quads(x, y));
      differences += same ? 0 : 1;
    }
  }
  return differences;
}

/// A ball that covers a part of the image.
View small_ball(const CameraModel& camera, double radius_mm, double azimuth_rad) {
  return testing::snapshot(
      testing::sphere(radius_mm), camera, look_from(azimuth_rad, 0.5, kStandOff));
}

TEST(LocalPlanes, DoNotDependOnTheViewThatLentItsMemory) {
  const CameraRays camera(small_camera_model());
  const LocalPlanesOptions extrapolating{.extrapolate_px = 3};
  const View small = small_ball(camera.model, 8.0, 0.0);
  const View large = small_ball(camera.model, 20.0, 0.4);
  LocalPlanes reused = local_planes(large, camera, extrapolating);
  reused = local_planes(small, camera, {}, std::move(reused));
  EXPECT_EQ(count_differences(reused, local_planes(small, camera)), 0);
  reused = local_planes(large, camera, {.every = 3}, std::move(reused));
  reused = local_planes(small, camera, extrapolating, std::move(reused));
  EXPECT_EQ(count_differences(reused, local_planes(small, camera, extrapolating)), 0);
}

TEST(LocalPlanes, OfEveryThirdPixelAreThoseOfAllPixels) {
  const CameraRays camera(small_camera_model());
  const View view = small_ball(camera.model, 20.0, 0.0);
  const LocalPlanes all = local_planes(view, camera);
  EXPECT_EQ(count_differences(all, local_planes(view, camera, {.every = 3}), 3), 0);
}

TEST(LocalPlanes, LieInTheirBox) {
  const CameraRays camera(small_camera_model());
  const LocalPlanes view =
      local_planes(small_ball(camera.model, 8.0, 0.0), camera, {.extrapolate_px = 3});
  EXPECT_LT(view.box.width(), view.planes.width() / 2);
  for (int y = 0; y < view.quads.height(); ++y) {
    for (int x = 0; x < view.quads.width(); ++x) {
      const bool outside =
          x < view.box.left || x >= view.box.right || y < view.box.top || y >= view.box.bottom;
      if (!outside) continue;
      EXPECT_FALSE(view.has_plane(x, y));
      EXPECT_EQ(view.quads(x, y).kind, LocalPlanes::Kind::Unseen);
    }
  }
}

TEST(LocalPlanes, RefuseAViewOfAnotherSize) {
  const View view = testing::snapshot(
      testing::floor_at(0.0), small_camera_model(100), look_from(0.0, 1.0, kStandOff));
  EXPECT_THROW(static_cast<void>(local_planes(view, CameraRays(small_camera_model(90)))), Error);
}

}  // namespace
}  // namespace frangia
