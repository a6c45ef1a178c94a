// Minimum zones against every zone that the points could touch.
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/features/fit_shape.h"
#include "frangia/features/internal/minimum_zone.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

double zone_noise(std::uint64_t seed, std::uint64_t i, std::uint64_t k) {
  return normal_from(hash(hash(seed, i), k));
}

/// The range of the distances of points from a center in n dimensions.
double ring_width(const Points& points, const Vector3d& center, int dimensions) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const Vector3d& point : points) {
    const double radius = (point - center).head(dimensions).norm();
    low = std::min(low, radius);
    high = std::max(high, radius);
  }
  return high - low;
}

/// The narrowest ring or shell: each one that cannot shrink touches n + 2 points with its two
/// surfaces, and these determine it by linear equations.
double narrowest_shell(const Points& points, int dimensions, double farthest) {
  const int contacts = dimensions + 2;
  const auto count = static_cast<unsigned>(points.size());
  double least = std::numeric_limits<double>::infinity();
  for (unsigned chosen = 0; chosen < (1U << count); ++chosen) {
    if (__builtin_popcount(chosen) != contacts) continue;
    for (unsigned outer = 1; outer + 1 < (1U << static_cast<unsigned>(contacts)); ++outer) {
      Eigen::MatrixXd equations(contacts, contacts);
      Eigen::VectorXd squares(contacts);
      int row = 0;
      for (unsigned i = 0; i < count; ++i) {
        if ((chosen >> i & 1U) == 0) continue;
        const bool is_outer = (outer >> static_cast<unsigned>(row) & 1U) != 0;
        equations.row(row).head(dimensions) = 2.0 * points[i].head(dimensions).transpose();
        equations(row, dimensions) = is_outer ? 1.0 : 0.0;
        equations(row, dimensions + 1) = is_outer ? 0.0 : 1.0;
        squares[row++] = points[i].head(dimensions).squaredNorm();
      }
      const Eigen::VectorXd solved = equations.partialPivLu().solve(squares);
      if (!solved.allFinite()) continue;
      Vector3d center = Vector3d::Zero();
      center.head(dimensions) = solved.head(dimensions);
      if (center.norm() < farthest) least = std::min(least, ring_width(points, center, dimensions));
    }
  }
  return least;
}

/// The width of a set of points: its planes of support touch an edge each, or a face and a corner.
double width_of(const Points& points) {
  double least = std::numeric_limits<double>::infinity();
  const auto try_normal = [&](const Vector3d& normal) {
    if (!(normal.norm() > 1e-9)) return;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vector3d& point : points) {
      low = std::min(low, point.dot(normal.normalized()));
      high = std::max(high, point.dot(normal.normalized()));
    }
    least = std::min(least, high - low);
  };
  for (const Vector3d& a : points)
    for (const Vector3d& b : points)
      for (const Vector3d& c : points)
        for (const Vector3d& d : points)
          try_normal((b - a).cross(d - c));
  return least;
}

/// Fits the shape of least squares; returns the range of the distances from it.
double least_squares_width(const Points& points, Shape& shape) {
  FeaturePoints all;
  std::vector<std::uint32_t> chosen;
  for (const Vector3d& point : points) {
    chosen.push_back(static_cast<std::uint32_t>(all.points_mm.size()));
    all.points_mm.push_back(point);
    all.normals.push_back(distance_to(shape, point).normal);
  }
  const ShapeFit fit = fit_shape(all, chosen, shape, {.gate_mm = 100.0, .robust = false});
  EXPECT_TRUE(fit.converged);
  shape = fit.shape;
  return fit.form_mm;
}

TEST(MinimumZoneSearch, FindsTheNarrowestRingOfAllThatTouchFourPoints) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Points points;
    for (std::uint64_t i = 0; i < 11; ++i) {
      const double angle = kTwoPi * static_cast<double>(i) / 11.0;
      const double radius = 20.0 + 0.05 * zone_noise(seed, i, 0);
      points.emplace_back(
          radius * std::cos(angle), radius * std::sin(angle), 0.5 * static_cast<double>(i % 3));
    }
    const Shape start{.kind = ShapeKind::Cylinder, .center_mm = {0.02, -0.03, 0}, .radius_mm = 20};
    const double width = minimum_zone_width(start, points, ZoneFreedom::Section);
    EXPECT_NEAR(width, narrowest_shell(points, 2, 5.0), 1e-8) << seed;
    EXPECT_LE(width, ring_width(points, start.center_mm, 2));
  }
}

TEST(MinimumZoneSearch, FindsTheNarrowestShellOfAllThatTouchFivePoints) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Points points;
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Vector3d direction(
          zone_noise(seed, i, 1), zone_noise(seed, i, 2), zone_noise(seed, i, 3));
      points.push_back((15.0 + 0.02 * zone_noise(seed, i, 4)) * direction.normalized());
    }
    Shape shape{.kind = ShapeKind::Sphere, .radius_mm = 15.0};
    const double wider = least_squares_width(points, shape);
    const double width = minimum_zone_width(shape, points, ZoneFreedom::All);
    EXPECT_NEAR(width, narrowest_shell(points, 3, 5.0), 1e-8) << seed;
    EXPECT_LT(width, wider);
  }
}

TEST(MinimumZoneSearch, FindsTheWidthOfPointsOnAPlane) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Eigen::AngleAxisd tilt(0.4, Vector3d(1.0, 0.3, 0.2).normalized());
    Points points;
    for (std::uint64_t i = 0; i < 25; ++i) {
      points.push_back(tilt * Vector3d(10.0 * static_cast<double>(i % 5),
                                       8.0 * static_cast<double>(i / 5),
                                       0.1 * zone_noise(seed, i, 5)));
    }
    Shape shape{
        .kind = ShapeKind::Plane, .center_mm = points[12], .axis = tilt * Vector3d::UnitZ()};
    const double wider = least_squares_width(points, shape);
    const double width = minimum_zone_width(shape, points, ZoneFreedom::All);
    EXPECT_NEAR(width, width_of(points), 1e-8) << seed;
    EXPECT_LE(width, wider);
  }
}

/// No cylinder near that of least squares has a narrower zone than the one that is stated.
TEST(MinimumZoneSearch, IsNotWiderThanThatOfManyOtherCylinders) {
  Points points;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const double angle = 2.4 * static_cast<double>(i);
    const double radius = 8.0 + 0.003 * zone_noise(9, i, 0);
    points.emplace_back(
        radius * std::cos(angle), radius * std::sin(angle), 0.05 * static_cast<double>(i));
  }
  Shape shape{.kind = ShapeKind::Cylinder, .center_mm = {0.0, 0.0, 10.0}, .radius_mm = 8.0};
  const double wider = least_squares_width(points, shape);
  const double width = minimum_zone_width(shape, points, ZoneFreedom::All);
  EXPECT_LT(width, wider);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(5);
    const double size = std::pow(10.0, -5.0 + 0.001 * static_cast<double>(i));
    for (Eigen::Index k = 0; k < 4; ++k)
      step[k] = size * zone_noise(10, i, static_cast<std::uint64_t>(k));
    const Shape other = moved(shape, step);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vector3d& point : points) {
      low = std::min(low, distance_to(other, point).distance_mm);
      high = std::max(high, distance_to(other, point).distance_mm);
    }
    ASSERT_GE(high - low, width - 1e-12);
  }
}

}  // namespace
}  // namespace frangia
