#include "frangia/local_fit/surfel_map.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/analytic_views.h"

namespace frangia {
namespace {

constexpr double kRadius_mm = 40.0;

struct SphereMap {
  CameraRays camera{testing::small_camera_model(200, 1000.0)};
  View view;
  SurfelMap map;

  explicit SphereMap(std::size_t pixels) {
    view = testing::snapshot(
        testing::sphere(kRadius_mm), camera.model, testing::look_from(0.3, 0.4, 650.0));
    map = make_surfel_map(local_planes(view, camera), camera, pixels);
  }
  [[nodiscard]] std::size_t count() const { return pick_surfels(map, 1000000).size(); }
};

TEST(SurfelMap, HoldsPointsAndNormalsOfTheSurface) {
  const SphereMap sphere(10000);
  EXPECT_EQ(sphere.map.stride, 2);
  ASSERT_GT(sphere.count(), 1000U);
  double squares = 0.0;
  double predicted = 0.0;
  const Eigen::Isometry3d object_from_rig = sphere.view.rig_from_object.inverse();
  for (const SurfelMap::Surfel& surfel : pick_surfels(sphere.map, 1000000)) {
    const Eigen::Vector3d point = object_from_rig * surfel.point_mm.cast<double>();
    const Eigen::Vector3d normal = object_from_rig.linear() * surfel.normal.cast<double>();
    EXPECT_GT(normal.dot(point.normalized()), 0.97);
    squares += std::pow(point.norm() - kRadius_mm, 2);
    predicted += std::pow(static_cast<double>(surfel.sigma_mm), 2);
  }
  EXPECT_NEAR(squares / predicted, 1.0, 0.25);
}

TEST(SurfelMap, HoldsNoMoreSurfelsThanRequested) {
  const SphereMap sphere(1000);
  EXPECT_EQ(sphere.map.stride, 7);
  EXPECT_LE(sphere.map.surfels.pixels().size(), 1000U);
}

TEST(SurfelMap, CoversOnlyThePartOfTheViewThatHasSurfels) {
  const CameraRays camera(testing::small_camera_model(200, 1000.0));
  const View view = testing::snapshot(
      testing::sphere(10.0, {20.0, 0.0, 15.0}), camera.model, testing::look_from(0.0, 0.0, 650.0));
  const SurfelMap map = make_surfel_map(local_planes(view, camera), camera, 10000);
  EXPECT_LT(map.surfels.width(), 20);  // a ball of 31 px, at every second pixel
  EXPECT_LT(map.surfels.height(), 20);
  for (int y = 0; y < map.surfels.height(); ++y) {
    for (int x = 0; x < map.surfels.width(); ++x) {
      if (!(map.surfels(x, y).sigma_mm > 0.0F)) continue;
      const Eigen::Vector2d pixel = camera.model.project(map.surfels(x, y).point_mm.cast<double>());
      EXPECT_NEAR(pixel.x(), (map.first_column + x) * map.stride, 1e-3);
      EXPECT_NEAR(pixel.y(), (map.first_row + y) * map.stride, 1e-3);
    }
  }
  EXPECT_GT(pick_surfels(map, 1000000).size(), 50U);
}

TEST(PickSurfels, SpreadsThemEvenly) {
  const SphereMap sphere(10000);
  const auto picked = pick_surfels(sphere.map, 100);
  EXPECT_EQ(picked.size(), 100U);
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const SurfelMap::Surfel& surfel : picked)
    mean += surfel.point_mm / 100.0F;
  Eigen::Vector3f mean_of_all = Eigen::Vector3f::Zero();
  for (const SurfelMap::Surfel& surfel : pick_surfels(sphere.map, 1000000))
    mean_of_all += surfel.point_mm / static_cast<float>(sphere.count());
  EXPECT_LT((mean - mean_of_all).norm(), 0.1F * static_cast<float>(kRadius_mm));
}

}  // namespace
}  // namespace frangia
