#include "frangia/features/fit_shape.h"

#include <numeric>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/features/shape_uncertainty.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 600;

double uniform(std::uint64_t stream, int i) {
  return uniform_from(hash(stream, static_cast<std::uint64_t>(i)));
}

/// A point of a shape about z at two numbers from 0 to 1.
Vector3d place_on(const Shape& shape, double u, double v) {
  const double angle = 0.3 + 4.0 * u;
  const Vector3d round(std::cos(angle), std::sin(angle), 0.0);
  switch (shape.kind) {
    case ShapeKind::Plane:
      return {20.0 * u, 30.0 * v, 0.0};
    case ShapeKind::Sphere: {
      const double polar = 0.2 + 1.8 * v;
      return shape.radius_mm * (std::sin(polar) * round + std::cos(polar) * Vector3d::UnitZ());
    }
    case ShapeKind::Cone: {
      const double height = 20.0 * v - 10.0;
      return (shape.radius_mm + height * std::tan(shape.half_angle_rad)) * round +
             height * Vector3d::UnitZ();
    }
    case ShapeKind::Torus: {
      const double tube = 0.2 + 3.5 * v;
      return (shape.radius_mm + shape.tube_radius_mm * std::cos(tube)) * round +
             shape.tube_radius_mm * std::sin(tube) * Vector3d::UnitZ();
    }
    default:
      return shape.radius_mm * round + (20.0 * v - 10.0) * Vector3d::UnitZ();
  }
}

Shape about_z(ShapeKind kind) {
  return {kind, Vector3d::Zero(), Vector3d::UnitZ(), 15.0, 0.25, 4.0};
}

/// Points whose shape of least squares is known: their residuals are orthogonal to the derivatives
/// by all parameters.
FeaturePoints points_about(const Shape& shape) {
  const int count = parameter_count(shape.kind);
  FeaturePoints points;
  Eigen::VectorXd residuals(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    points.points_mm.push_back(place_on(shape, uniform(1, i), uniform(2, i)));
    residuals[i] = 0.1 * normal_from(hash(3, static_cast<std::uint64_t>(i)));
  }
  const std::vector<Vector3d> ideal = points.points_mm;
  for (int round = 0; round < 20; ++round) {
    Eigen::MatrixXd jacobian(kPoints, count);
    for (int i = 0; i < kPoints; ++i) {
      const auto k = static_cast<std::size_t>(i);
      points.points_mm[k] = ideal[k] + residuals[i] * distance_to(shape, ideal[k]).normal;
      jacobian.row(i) = distance_to(shape, points.points_mm[k]).derivatives.head(count).transpose();
    }
    residuals -= jacobian * jacobian.colPivHouseholderQr().solve(residuals);
  }
  for (std::size_t k = 0; k < ideal.size(); ++k)
    points.points_mm[k] =
        ideal[k] + residuals[static_cast<Eigen::Index>(k)] * distance_to(shape, ideal[k]).normal;
  return points;
}

std::vector<std::uint32_t> all_of(const FeaturePoints& points) {
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

class FitShape : public ::testing::TestWithParam<ShapeKind> {};

TEST_P(FitShape, FindsTheKnownShapeOfLeastSquares) {
  const Shape truth = about_z(GetParam());
  const FeaturePoints points = points_about(truth);
  Shape start = truth;
  start.center_mm += Vector3d(0.4, -0.3, 0.2);
  start.axis = Vector3d(0.03, -0.02, 1.0).normalized();
  start.radius_mm += 0.5;
  start.half_angle_rad += 0.02;
  start.tube_radius_mm -= 0.2;
  const ShapeFit fit = fit_shape(points, all_of(points), start, {.gate_mm = 50.0, .robust = false});
  ASSERT_TRUE(fit.converged);
  const Shape& found = fit.shape;
  if (truth.kind != ShapeKind::Sphere) {
    EXPECT_LT(found.axis.cross(truth.axis).norm(), 1e-7);
  }
  // The center may lie anywhere along an axis, or in a plane.
  const Vector3d off = found.center_mm - truth.center_mm;
  if (truth.kind == ShapeKind::Plane) {
    EXPECT_NEAR(off.z(), 0.0, 1e-6);
  } else {
    EXPECT_LT(off.head<2>().norm(), 1e-6);
    const double slope = truth.kind == ShapeKind::Cone ? std::tan(truth.half_angle_rad) : 0.0;
    EXPECT_NEAR(found.radius_mm, truth.radius_mm + slope * off.z(), 1e-6);
  }
  if (truth.kind == ShapeKind::Cone) {
    EXPECT_NEAR(found.half_angle_rad, 0.25, 1e-7);
  }
  if (truth.kind == ShapeKind::Torus) {
    EXPECT_NEAR(found.tube_radius_mm, 4.0, 1e-6);
  }
  EXPECT_EQ(fit.points, static_cast<std::size_t>(kPoints));
}

TEST_P(FitShape, DerivativesAreThoseOfTheDistance) {
  Shape shape = about_z(GetParam());
  shape.axis = Vector3d(0.3, -0.5, 0.8).normalized();
  shape.center_mm = {1.0, 2.0, 3.0};
  const Vector3d point(11.0, 9.0, -4.0);
  const ShapeDistance at = distance_to(shape, point);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < parameter_count(shape.kind); ++i) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(parameter_count(shape.kind));
    step[i] = kStep;
    const double ahead = distance_to(moved(shape, step), point).distance_mm;
    const double behind = distance_to(moved(shape, -step), point).distance_mm;
    EXPECT_NEAR(at.derivatives[i], (ahead - behind) / (2.0 * kStep), 1e-6) << i;
  }
  const Vector3d out = point + kStep * at.normal;
  EXPECT_NEAR((distance_to(shape, out).distance_mm - at.distance_mm) / kStep, 1.0, 1e-6);
}

TEST_P(FitShape, IgnoresOutliers) {
  const Shape truth = about_z(GetParam());
  FeaturePoints points = points_about(truth);
  for (std::size_t i = 0; i < points.size(); i += 20)
    points.points_mm[i] +=
        Vector3d(0.0, 0.0, 3.0) + 2.0 * distance_to(truth, points.points_mm[i]).normal;
  const ShapeFit fit = fit_shape(points, all_of(points), truth, {.gate_mm = 8.0});
  ASSERT_TRUE(fit.converged);
  const double radius_off = truth.kind == ShapeKind::Plane || truth.kind == ShapeKind::Cone
                                ? 0.0
                                : fit.shape.radius_mm - truth.radius_mm;
  EXPECT_NEAR(radius_off, 0.0, 0.03);
  EXPECT_NEAR(fit.rms_mm, 0.1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         FitShape,
                         ::testing::Values(ShapeKind::Plane,
                                           ShapeKind::Cylinder,
                                           ShapeKind::Sphere,
                                           ShapeKind::Cone,
                                           ShapeKind::Torus));

/// Points of half a cylinder with errors that are alike over patches, and an offset of all.
FeaturePoints correlated_cylinder(double noise, double shared, std::uint64_t seed) {
  constexpr int kAround = 60;
  constexpr int kAlong = 40;
  constexpr int kPatch = 4;  // points a side that have the same error
  FeaturePoints points;
  const double offset = shared * normal_from(hash(seed, 1U << 30U));
  for (int i = 0; i < kAround; ++i) {
    for (int k = 0; k < kAlong; ++k) {
      const double angle = 3.5 * i / kAround;
      const auto patch = static_cast<std::uint64_t>((i / kPatch) * kAlong + k / kPatch);
      const double radius = 12.0 + offset + noise * normal_from(hash(seed, patch));
      const Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
      points.points_mm.emplace_back(radius * outward + 0.5 * k * Vector3d::UnitZ());
      points.normals.push_back(outward);
      points.noise_mm.push_back(noise);
      points.systematic_mm.push_back(shared);
    }
  }
  return points;
}

// The circle of least squares that Gander, Golub and Strebel 1994 publish for six points (BIT 34,
// 558-578): center (4.7398, 2.9835), radius 4.7142. Along z it is a cylinder.
TEST(PublishedFit, IsTheCircleOfSixPoints) {
  FeaturePoints points;
  for (int level = -10; level <= 10; ++level) {
    for (const auto& [x, y] : {std::pair{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}}) {
      points.points_mm.emplace_back(x, y, level);
      points.normals.push_back(Vector3d(x - 5.0, y - 3.0, 0.0).normalized());
    }
  }
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  const Shape start{ShapeKind::Cylinder, {5.0, 3.0, 0.0}, Vector3d::UnitZ(), 5.0, 0.0, 0.0};
  const ShapeFit found = fit_shape(points, all, start, {.gate_mm = 20.0, .robust = false});
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.shape.center_mm.x(), 4.7398, 5.1e-5);
  EXPECT_NEAR(found.shape.center_mm.y(), 2.9835, 5.1e-5);
  EXPECT_NEAR(found.shape.radius_mm, 4.7142, 5.1e-5);
  EXPECT_NEAR(std::abs(found.shape.axis.z()), 1.0, 1e-9);
}

TEST(ShapeUncertainty, CoversDiametersOverSeeds) {
  constexpr int kSeeds = 250;
  for (const double shared : {0.0, 0.004}) {
    int covered = 0;
    double mean_u95 = 0.0;
    double squares = 0.0;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const FeaturePoints points =
          correlated_cylinder(0.01, shared, hash(static_cast<std::uint64_t>(seed)));
      const auto all = all_of(points);
      const Shape start{ShapeKind::Cylinder, {0, 0, 10}, Vector3d::UnitZ(), 12.0};
      const ShapeFit fit = fit_shape(points, all, start, {.gate_mm = 0.2});
      const ShapeUncertainty u = shape_uncertainty(points, all, fit);
      const double error = 2.0 * fit.shape.radius_mm - 24.0;
      if (std::abs(error) <= u.u95_mm) ++covered;
      mean_u95 += u.u95_mm / kSeeds;
      squares += error * error / kSeeds;
      EXPECT_NEAR(u.systematic_mm, 2.0 * shared, 1e-9 + 0.05 * shared);
    }
    EXPECT_GE(covered, static_cast<int>(0.92 * kSeeds)) << shared;
    EXPECT_LE(covered, static_cast<int>(0.985 * kSeeds)) << shared;
    EXPECT_LT(mean_u95, 1.2 * 1.96 * std::sqrt(squares)) << shared;
  }
}

TEST(ShapeUncertainty, IsMissingForTooFewPoints) {
  FeaturePoints points = correlated_cylinder(0.01, 0.0, 1);
  const std::vector<std::uint32_t> few{0, 500, 900, 1300, 1700, 2100};
  const Shape start{ShapeKind::Cylinder, {0, 0, 10}, Vector3d::UnitZ(), 12.0};
  const ShapeFit fit = fit_shape(points, few, start, {.gate_mm = 0.2});
  EXPECT_TRUE(std::isnan(shape_uncertainty(points, few, fit).u95_mm));
}

TEST(FitShapeOf, RejectsLines) {
  const FeaturePoints points = correlated_cylinder(0.01, 0.0, 1);
  const auto all = all_of(points);
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(fit_shape(points, all, Shape{ShapeKind::Line}, {.gate_mm = 1.0}));
            }).find("lines and circles"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
