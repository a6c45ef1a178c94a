// Minimum zones whose width is known from analysis.
#include "frangia/features/internal/minimum_zone.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/features/fit_shape.h"
#include "frangia/features/geometric_tolerance.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

TEST(ChebyshevFit, OfXCubedIsTheChebyshevPolynomial) {
  // The best line through x^3 on [-1, 1] is 3/4 x, with the largest error 1/4.
  constexpr int kCount = 2001;
  Eigen::MatrixXd a(kCount, 2);
  Eigen::VectorXd b(kCount);
  for (int i = 0; i < kCount; ++i) {
    const double x = -1.0 + 2.0 * i / (kCount - 1);
    a.row(i) << 1.0, 1000.0 * x;  // columns of unlike size
    b[i] = x * x * x;
  }
  const ChebyshevFit fit = chebyshev_fit(a, b);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.largest, 0.25, 1e-7);
  EXPECT_NEAR(fit.parameters[0], 0.0, 1e-7);
  EXPECT_NEAR(fit.parameters[1], 0.75e-3, 1e-9);
}

TEST(ChebyshevFit, IsNotWorseThanAnyOfManyOthers) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd a(300, 4);
  Eigen::VectorXd b(300);
  for (double& one : a.reshaped())
    one = normal(random);
  for (double& one : b)
    one = normal(random);
  const ChebyshevFit fit = chebyshev_fit(a, b);
  ASSERT_TRUE(fit.converged);
  for (int i = 0; i < 5000; ++i) {
    Eigen::VectorXd other = fit.parameters;
    const double size = std::pow(10.0, -6.0 + 6.0 * i / 5000.0);
    for (double& one : other)
      one += size * normal(random);
    EXPECT_GE((a * other - b).cwiseAbs().maxCoeff(), fit.largest * (1.0 - 1e-9));
  }
}

TEST(ChebyshevFit, ToleratesColumnsThatDependOnEachOther) {
  Eigen::MatrixXd a(5, 3);
  Eigen::VectorXd b(5);
  for (int i = 0; i < 5; ++i) {
    a.row(i) << 1.0, 2.0, 0.0;
    b[i] = i;
  }
  EXPECT_NEAR(chebyshev_fit(a, b).largest, 2.0, 1e-6);
}

/// Points that lie on the two limits of the zone of this width, alternately, all over a shape.
std::vector<Vector3d> points_of_zone(ShapeKind kind, double width_mm) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vector3d> points;
  for (int i = 0; i < 4000; ++i) {
    const double off = (i % 2 == 0 ? 0.5 : -0.5) * width_mm;
    const double angle = kPi * uniform(random);
    const double height = uniform(random);
    Vector3d point;
    if (kind == ShapeKind::Plane) {
      point = {30.0 * height, 20.0 * uniform(random), off};
    } else if (kind == ShapeKind::Sphere) {
      const double across = std::sqrt(1.0 - height * height);
      point = (15.0 + off) * Vector3d(across * std::cos(angle), across * std::sin(angle), height);
    } else {
      point = {(10.0 + off) * std::cos(angle), (10.0 + off) * std::sin(angle), 25.0 * height};
    }
    points.push_back(point);
  }
  return points;
}

TEST(MinimumZone, IsFoundFromAnInexactStart) {
  for (const ShapeKind kind : {ShapeKind::Plane, ShapeKind::Sphere, ShapeKind::Cylinder}) {
    Shape start{.kind = kind, .center_mm = {0.02, -0.03, 0.01}};
    start.axis = Vector3d(0.002, -0.001, 1.0).normalized();
    start.radius_mm = kind == ShapeKind::Sphere ? 15.05 : 9.96;
    const std::vector<Vector3d> points = points_of_zone(kind, 0.04);
    EXPECT_NEAR(minimum_zone_width(start, points, ZoneFreedom::All), 0.04, 2e-4)
        << name_of(kind);  // the points are random: the zone may tilt a little between them
    EXPECT_LE(minimum_zone_width(start, points, ZoneFreedom::All), 0.04 + 1e-9) << name_of(kind);
  }
}

TEST(MinimumZone, OfASectionMovesTheCenterOnly) {
  // An eccentric circle is round; lobes are not.
  std::vector<Vector3d> points;
  std::vector<Vector3d> lobed;
  for (int i = 0; i < 720; ++i) {
    const double angle = kTwoPi * i / 720.0;
    const Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
    points.push_back(Vector3d(0.1, 0.05, 3.0) + 10.0 * outward);
    lobed.push_back(Vector3d(0.1, 0.05, 3.0) + (10.0 + 0.02 * std::cos(3.0 * angle)) * outward);
  }
  const Shape cylinder{.kind = ShapeKind::Cylinder, .radius_mm = 10.0};
  EXPECT_NEAR(minimum_zone_width(cylinder, points, ZoneFreedom::Section), 0.0, 1e-6);
  EXPECT_NEAR(minimum_zone_width(cylinder, lobed, ZoneFreedom::Section), 0.04, 1e-5);
}

TEST(MinimumZone, OfFlatnessIsNarrowerThanThatOfLeastSquares) {
  // z = a x^3 over a square: 0.8 a from the least-squares plane, 0.5 a in the narrowest zone.
  constexpr double kHeight = 0.1;
  MeasuredFeature plane;
  FeaturePoints points;
  std::vector<std::uint32_t> all;
  for (int y = 0; y <= 100; ++y) {
    for (int x = 0; x <= 100; ++x) {
      const double at = -1.0 + 0.02 * x;
      plane.points_mm.emplace_back(20.0 * at, 0.4 * y - 20.0, kHeight * at * at * at);
      all.push_back(static_cast<std::uint32_t>(all.size()));
    }
  }
  points.points_mm = plane.points_mm;
  points.normals.assign(all.size(), Vector3d::UnitZ());
  plane.feature.fit =
      fit_shape(points, all, {.kind = ShapeKind::Plane}, {.gate_mm = 1.0, .robust = false});
  const auto flatness = [&](FormReference reference) {
    return measure(Characteristic::Flatness, plane, nullptr, Vector3d::Zero(), reference).value;
  };
  // Linear functions in blocks cut the ends of the cubic a little.
  EXPECT_NEAR(flatness(FormReference::LeastSquares), 0.8 * kHeight, 0.05 * kHeight);
  EXPECT_NEAR(flatness(FormReference::MinimumZone), 0.5 * kHeight, 0.02 * kHeight);
}

}  // namespace
}  // namespace frangia
