#include <vector>

#include <gtest/gtest.h>

#include "frangia/inspect/surface_error.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::box;

/// A camera at the origin that looks along z and a projector beside it, aimed at a cube 500 mm
/// away.
Rig two_eyes() {
  Rig rig;
  rig.reference().model = {.width_px = 200,
                           .height_px = 200,
                           .focal_px = {800.0, 800.0},
                           .principal_point_px = {99.5, 99.5}};
  rig.projector.model = AngularModel{rad_from_deg(-10.0), rad_from_deg(10.0)};
  rig.projector.position_mm = {100.0, 0.0, 0.0};
  rig.projector.rotation = Eigen::AngleAxisd(std::atan(0.2), Eigen::Vector3d::UnitY()).matrix();
  rig.turntable = Turntable{{0.0, 0.0, 500.0}, {0.0, -1.0, 0.0}};
  return rig;
}

TEST(SurfaceCompleteness, IsTheShareOfTheCoveredArea) {
  const Mesh cube = box({-10, -10, 0}, {10, 10, 20});
  Mesh half = cube;
  half.triangles.resize(6);
  CompletenessOptions options;
  options.within_mm = 1e-3;
  EXPECT_EQ(surface_completeness(RayScene(cube), RayScene(cube), options).share, 1.0);
  EXPECT_NEAR(surface_completeness(RayScene(cube), RayScene(half), options).share, 0.5, 1e-3);
}

TEST(SurfaceCompleteness, CountsOnlyWhatTheRigCanMeasure) {
  const Rig rig = two_eyes();
  const RayScene cube(box({-10, -10, -10}, {10, 10, 10}));
  const std::vector<Eigen::Isometry3d> poses{rig.rig_from_object(0.0)};
  const auto seen = surface_completeness(cube, cube, MeasurementViews{rig, poses});
  // Camera and projector both face one of the six faces; others are seen at grazing angles.
  EXPECT_NEAR(static_cast<double>(seen.count) / 100000.0, 1.0 / 6.0, 1e-3);
  const std::vector<Eigen::Isometry3d> turned{rig.rig_from_object(0.0),
                                              rig.rig_from_object(0.5 * kPi)};
  EXPECT_NEAR(
      static_cast<double>(surface_completeness(cube, cube, MeasurementViews{rig, turned}).count) /
          100000.0,
      2.0 / 6.0,
      1e-3);
}

TEST(IsMeasurable, NeedsUnoccludedCameraAndProjectorThatTheSurfaceFaces) {
  const Rig rig = two_eyes();
  const std::vector<Eigen::Isometry3d> poses{rig.rig_from_object(0.0)};
  const MeasurementViews view{rig, poses};
  const RayScene nothing((Mesh()));
  const auto measurable = [&](const RayScene& scene, const Eigen::Vector3d& normal) {
    return is_measurable(scene, {0, 0, 0}, normal.normalized(), view, rad_from_deg(75.0));
  };
  EXPECT_TRUE(measurable(nothing, {1, 0, 0}));  // x points to the camera
  EXPECT_FALSE(measurable(nothing, {-1, 0, 0}));
  EXPECT_FALSE(measurable(nothing, {0.2, 0, 1}));
  // An obstacle in front of the camera, then of the projector (y points away from it).
  EXPECT_FALSE(measurable(RayScene(box({100, -1, -1}, {101, 1, 1})), {1, 0, 0}));
  const double side = rig.rig_from_object(0.0).inverse().operator*(rig.projector.position_mm).y();
  const auto y = static_cast<float>(side / 5.0);
  EXPECT_FALSE(measurable(RayScene(box({100, y - 1, -1}, {101, y + 1, 1})), {1, 0, 0}));
  EXPECT_TRUE(measurable(RayScene(box({100, -y - 1, -1}, {101, -y + 1, 1})), {1, 0, 0}));
}

TEST(IsMeasurable, IsLimitedToTheFieldsOfCameraAndProjector) {
  Rig rig = two_eyes();
  const std::vector<Eigen::Isometry3d> poses{rig.rig_from_object(0.0)};
  const RayScene nothing((Mesh()));
  const auto measurable = [&](double y) {
    return is_measurable(nothing, {0, y, 0}, {1, 0, 0}, MeasurementViews{rig, poses}, 1.3);
  };
  EXPECT_TRUE(measurable(60.0));
  EXPECT_FALSE(measurable(65.0));  // half the picture is 100 px / 800 px * 500 mm = 62.5 mm
  rig.projector.model = AngularModel{rad_from_deg(-1.0), rad_from_deg(1.0)};
  EXPECT_TRUE(measurable(0.0));
  EXPECT_FALSE(measurable(60.0));
}

TEST(IsMeasurable, NeedsTwoCamerasWhereTheProjectorIsALabel) {
  Rig rig = two_eyes();
  const std::vector<Eigen::Isometry3d> poses{rig.rig_from_object(0.0)};
  const RayScene nothing((Mesh()));
  PosedCamera second{rig.reference(), rig.projector.position_mm, rig.projector.rotation};
  rig.cameras.push_back(second);
  rig.projector.is_label = true;
  rig.projector.position_mm.setConstant(std::nan(""));
  rig.projector.rotation.setConstant(std::nan(""));
  const auto measurable = [&](const RayScene& scene) {
    return is_measurable(scene, {0, 0, 0}, {1, 0, 0}, MeasurementViews{rig, poses}, 1.3);
  };
  EXPECT_TRUE(measurable(nothing));
  const double side = rig.rig_from_object(0.0).inverse().operator*(second.position_mm).y();
  const auto y = static_cast<float>(side / 5.0);
  EXPECT_FALSE(measurable(RayScene(box({100, y - 1, -1}, {101, y + 1, 1}))));
}

TEST(SurfaceCompleteness, RefusesAReferenceWithoutTriangles) {
  EXPECT_THROW(static_cast<void>(surface_completeness(RayScene(Mesh{}), RayScene(Mesh{}))), Error);
}

}  // namespace
}  // namespace frangia
