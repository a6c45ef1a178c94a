#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/range/triangulate.h"

#include "support/linspace.h"

namespace frangia {
namespace {

Projector angular() {
  Projector projector;
  projector.model = AngularModel{rad_from_deg(-12.0), rad_from_deg(12.0)};
  projector.position_mm = {342.0, 0.0, -449.7};
  projector.rotation = Eigen::AngleAxisd(rad_from_deg(-20.0), Eigen::Vector3d::UnitY())
                           .toRotationMatrix()
                           .transpose();
  return projector;
}

Projector angular_with_wavefront() {
  Projector projector = angular();
  std::get<AngularModel>(projector.model).wavefront.coefficients_rad = {
      2e-4, -3e-4, 1e-4, 5e-5, -1e-4, 2e-4};
  return projector;
}

Projector pinhole() {
  Projector projector;
  projector.model = CameraModel{.width_px = 1280,
                                .height_px = 800,
                                .focal_px = {1900.0, 1895.0},
                                .principal_point_px = {650.0, 380.0},
                                .distortion = {-0.08, 0.03, 3e-4, -2e-4, 0.01}};
  projector.position_mm = {-180.0, -20.0, 30.0};
  projector.rotation = (Eigen::AngleAxisd(rad_from_deg(-21.0), Eigen::Vector3d::UnitY()) *
                        Eigen::AngleAxisd(rad_from_deg(2.0), Eigen::Vector3d::UnitX()))
                           .toRotationMatrix();
  return projector;
}

Pattern columns() {
  return {.name = "p", .period_px = 20.0};
}
Pattern rows() {
  return {.name = "p", .direction = FringeDirection::Horizontal, .period_px = 20.0};
}
Pattern degrees() {
  return {.name = "p", .fringes_per_degree = 1.5};
}

class FringeRay : public ::testing::TestWithParam<std::pair<Pattern, Projector>> {};

TEST_P(FringeRay, FindsThePointLitWithThePhase) {
  const auto& [pattern, projector] = GetParam();
  for (const double x : testing::linspace(10, -60.0, 57.0)) {
    for (const double y : testing::linspace(6, -50.0, 35.0)) {
      for (const double z : testing::linspace(5, 430.0, 554.0)) {
        const Eigen::Vector3d point(x, y, z);
        const double phase = phase_at(point, pattern, projector);
        const RayDepth found = intersect_fringe({x / z, y / z}, phase, pattern, projector);
        ASSERT_NEAR(found.depth_mm, z, 1e-6) << point.transpose();
      }
    }
  }
}

TEST_P(FringeRay, GivesTheDerivativeOfDepthWithRespectToPhase) {
  const auto& [pattern, projector] = GetParam();
  const Eigen::Vector2d ray(0.05, -0.03);
  const double phase = phase_at(500.0 * Eigen::Vector3d(0.05, -0.03, 1.0), pattern, projector);
  const double h = 1e-4;
  const double numeric = (intersect_fringe(ray, phase + h, pattern, projector).depth_mm -
                          intersect_fringe(ray, phase - h, pattern, projector).depth_mm) /
                         (2.0 * h);
  const RayDepth found = intersect_fringe(ray, phase, pattern, projector);
  EXPECT_NEAR(found.mm_per_rad / numeric, 1.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Projectors,
                         FringeRay,
                         ::testing::Values(std::pair(degrees(), angular()),
                                           std::pair(degrees(), angular_with_wavefront()),
                                           std::pair(columns(), pinhole()),
                                           std::pair(rows(), pinhole())));

TEST(FringeRayAtInfinity, IsMissingWithoutAnIntersectionInFrontOfTheCamera) {
  const Projector projector = angular();
  // Light that diverges from the camera's axis does not intersect it.
  const RayDepth found = intersect_fringe({0.0, 0.0}, 2.0 * kPi * 1.5 * 60.0, degrees(), projector);
  EXPECT_TRUE(std::isnan(found.depth_mm));
}

}  // namespace
}  // namespace frangia
