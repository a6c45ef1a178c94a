#include "frangia/features/fit_points.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

/// Points of a patch of a shape, with a ripple of 10 um in place of noise.
template <typename Place>
FeaturePoints patch_of(const Place& place) {
  FeaturePoints points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const double ripple = (i + j) % 2 == 0 ? 0.01 : -0.01;
      const auto [on, normal] = place(i / 40.0, j / 40.0);
      points.points_mm.push_back(on + ripple * normal);
      points.normals.push_back(normal);
      points.noise_mm.push_back(0.01);
    }
  }
  return points;
}

Feature fitted(const FeaturePoints& points, ShapeKind kind) {
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  return fit_points(points, all, kind);
}

using OnShape = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

TEST(FitPoints, FindsACylinderOnAQuarterOfIt) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  const FeaturePoints points = patch_of([&](double a, double b) -> OnShape {
    const Eigen::Vector3d normal = std::cos(1.5 * a) * u + std::sin(1.5 * a) * v;
    return {Eigen::Vector3d(40, -5, 8) + 12.0 * normal + 30.0 * b * axis, normal};
  });
  const Feature found = fitted(points, ShapeKind::Cylinder);
  EXPECT_NEAR(found.fit.shape.radius_mm, 12.0, 0.005);
  EXPECT_NEAR(std::abs(found.fit.shape.axis.dot(axis)), 1.0, 1e-6);
  EXPECT_NEAR(found.fit.rms_mm, 0.01, 0.001);
  EXPECT_LT(2.0 * std::abs(found.fit.shape.radius_mm - 12.0), found.uncertainty.u95_mm + 0.002);
}

TEST(FitPoints, HasNoUncertaintyWithoutNoise) {
  FeaturePoints points = patch_of([](double a, double b) -> OnShape {
    return {Eigen::Vector3d(30.0 * a, 20.0 * b, 0.0), Eigen::Vector3d::UnitZ()};
  });
  EXPECT_TRUE(fitted(points, ShapeKind::Plane).uncertainty.is_known);
  points.noise_mm.clear();
  EXPECT_FALSE(fitted(points, ShapeKind::Plane).uncertainty.is_known);
}

TEST(FitPoints, FindsASphereOnACap) {
  const FeaturePoints points = patch_of([](double a, double b) -> OnShape {
    const Eigen::Vector3d normal = Eigen::Vector3d(a - 0.5, b - 0.5, 1.0).normalized();
    return {Eigen::Vector3d(3, 4, 500) + 20.0 * normal, normal};
  });
  const Feature found = fitted(points, ShapeKind::Sphere);
  EXPECT_NEAR(found.fit.shape.radius_mm, 20.0, 0.02);
  EXPECT_NEAR((found.fit.shape.center_mm - Eigen::Vector3d(3, 4, 500)).norm(), 0.0, 0.02);
}

TEST(FitPoints, FindsAPlaneAndIgnoresWhatLiesFarFromIt) {
  FeaturePoints points = patch_of([](double a, double b) -> OnShape {
    return {Eigen::Vector3d(10 * a, 10 * b, 7), Eigen::Vector3d::UnitZ()};
  });
  points.points_mm[5].z() = 9.0;
  const Feature found = fitted(points, ShapeKind::Plane);
  EXPECT_NEAR(std::abs(found.fit.shape.axis.z()), 1.0, 1e-6);
  EXPECT_NEAR(found.fit.shape.center_mm.z(), 7.0, 0.002);
  EXPECT_EQ(found.fit.points, points.size() - 1);
}

TEST(FitPoints, RefusesWhatDetermineNoShape) {
  FeaturePoints points;
  for (int i = 0; i < 4; ++i) {
    points.points_mm.emplace_back(i, 0, 0);
    points.normals.emplace_back(0, 0, 1);
  }
  EXPECT_NE(error_of([&] { static_cast<void>(fitted(points, ShapeKind::Plane)); }).find("plane"),
            std::string::npos);
  EXPECT_NE(error_of([&] { static_cast<void>(fitted(points, ShapeKind::Torus)); }), "");
}

}  // namespace
}  // namespace frangia
