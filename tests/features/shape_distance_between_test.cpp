#include "frangia/features/internal/shape_distance_between.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/features/filtered_range.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

Shape shape_at(ShapeKind kind, const Vector3d& center, const Vector3d& axis = Vector3d::UnitZ()) {
  Shape shape;
  shape.kind = kind;
  shape.center_mm = center;
  shape.axis = axis.normalized();
  return shape;
}

TEST(DistanceBetween, OfAPointIsThatFromThePlaneTheAxisOrTheCenter) {
  const Vector3d point(3.0, 4.0, 12.0);
  for (const ShapeKind kind : {ShapeKind::Line, ShapeKind::Cylinder, ShapeKind::Cone})
    EXPECT_NEAR(distance_between(shape_at(kind, {0, 0, 5}), point), 5.0, 1e-12);
  for (const ShapeKind kind : {ShapeKind::Sphere, ShapeKind::Circle, ShapeKind::Torus})
    EXPECT_NEAR(distance_between(shape_at(kind, Vector3d::Zero()), point), 13.0, 1e-12);
  EXPECT_NEAR(distance_between(shape_at(ShapeKind::Plane, {9, 9, 15}), point), 3.0, 1e-12);
}

TEST(DistanceBetween, OfAPlaneIsAlongItsNormal) {
  const Shape plane = shape_at(ShapeKind::Plane, {50, 60, 2});
  for (const ShapeKind kind : {ShapeKind::Plane, ShapeKind::Sphere, ShapeKind::Cylinder}) {
    const Shape other = shape_at(kind, {1, 2, 9}, {0.05, 0.0, 1.0});
    EXPECT_NEAR(distance_between(other, plane), 7.0, 1e-12);
    if (kind != ShapeKind::Plane) {
      EXPECT_NEAR(distance_between(plane, other), 7.0, 1e-12);
    }
  }
  // Of two planes that are not quite parallel, the normal of the datum counts.
  const Shape tilted = shape_at(ShapeKind::Plane, {0, 0, 9}, {0.1, 0.0, 1.0});
  EXPECT_NEAR(distance_between(tilted, plane), 7.0, 1e-12);
  EXPECT_NEAR(distance_between(plane, tilted), std::abs(5.0 - 7.0) / std::sqrt(1.01), 1e-12);
}

TEST(DistanceBetween, OfTwoAxesIsAlongTheirCommonPerpendicular) {
  const Shape one = shape_at(ShapeKind::Cylinder, {0, 0, 0}, Vector3d::UnitX());
  EXPECT_NEAR(distance_between(one, shape_at(ShapeKind::Cone, {30, 40, 6}, {1, 1, 0})), 6.0, 1e-12);
  EXPECT_NEAR(distance_between(one, shape_at(ShapeKind::Line, {30, 3, 4}, {1, 0, 0})), 5.0, 1e-12);
  // Within about a degree they count as parallel: the distance at the center of the first.
  EXPECT_NEAR(
      distance_between(one, shape_at(ShapeKind::Line, {0, 3, 4}, {1, 0, 0.015})), 5.0, 1e-3);
  EXPECT_NEAR(
      distance_between(one, shape_at(ShapeKind::Line, {0, 3, 4}, {1, 0, 0.025})), 3.0, 1e-12);
}

TEST(DistanceBetween, OfACenterAndAnAxisIsTheSameBothWays) {
  const Shape ball = shape_at(ShapeKind::Sphere, {3, 4, 70});
  const Shape bore = shape_at(ShapeKind::Cylinder, {0, 0, 10});
  EXPECT_NEAR(distance_between(ball, bore), 5.0, 1e-12);
  EXPECT_NEAR(distance_between(bore, ball), 5.0, 1e-12);
  EXPECT_NEAR(distance_between(ball, shape_at(ShapeKind::Torus, {3, 0, 73})), 5.0, 1e-12);
  EXPECT_TRUE(has_axis(ShapeKind::Torus));
  EXPECT_FALSE(has_axis(ShapeKind::Sphere));
}

/// Values of a plane of this slope and noise over a square of 100 mm.
std::vector<SurfaceValue> sloped(int side, double slope, double noise) {
  std::vector<SurfaceValue> values;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vector3d at(100.0 * x / (side - 1), 100.0 * y / (side - 1), 0.0);
      const auto stream = static_cast<std::uint64_t>(side * y + x);
      values.push_back({at, slope * at.x() + noise * normal_from(hash(4, stream))});
    }
  }
  return values;
}

TEST(FilteredRange, IsTheRangeOfALinearFunctionWithoutItsNoise) {
  for (const int side : {5, 40}) {
    const FilteredRange exact = filtered_range(sloped(side, 0.01, 0.0));
    EXPECT_NEAR(exact.low, 0.0, 1e-9);
    EXPECT_NEAR(exact.high, 1.0, 1e-9);
    EXPECT_NEAR(exact.u95, 0.0, 1e-9);
    EXPECT_EQ(exact.values.size(), static_cast<std::size_t>(side * side));
    for (const SurfaceValue& one : exact.values)
      EXPECT_NEAR(one.value, 0.01 * one.point_mm.x(), 1e-9);
  }
  const FilteredRange noisy = filtered_range(sloped(40, 0.01, 0.02));
  EXPECT_NEAR(noisy.high - noisy.low, 1.0, noisy.u95);
  EXPECT_LT(noisy.u95, 0.15);
}

TEST(FilteredRange, StatesTheScatterOfOneBlock) {
  // 90 points are one block: a value at its corner has sqrt(7) times the sigma of the mean; two
  // ends, and two extremes of one block.
  std::vector<SurfaceValue> values = sloped(10, 0.0, 0.0);
  values.resize(90);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i].value = 0.03 * normal_from(hash(6, i));
  const double u = std::sqrt(7.0) * 0.03 / std::sqrt(90.0);
  const double wanted =
      std::hypot(1.96 * std::sqrt(2.0) * u, 2.0 * u * std::sqrt(2.0 * std::log(4.0)));
  // Never below it, and not much above: the means of few parts scatter.
  EXPECT_GT(filtered_range(values).u95, 0.9 * wanted);
  EXPECT_LT(filtered_range(values).u95, 2.2 * wanted);
}

TEST(FilteredRange, LeavesTheSlopeOpenAcrossAFlatBlock) {
  // Points of a plane tilted in space: the slope across it is not determined and must not explode.
  std::vector<SurfaceValue> values;
  for (int i = 0; i < 60; ++i) {
    const double x = i % 10;
    const double y = static_cast<double>(i / 10);
    values.push_back({{x, y, 1e-5 * normal_from(hash(static_cast<std::uint64_t>(i)))}, 0.1 * x});
  }
  const FilteredRange found = filtered_range(values);
  EXPECT_NEAR(found.low, 0.0, 1e-6);
  EXPECT_NEAR(found.high, 0.9, 1e-6);
}

}  // namespace
}  // namespace frangia
