#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/geometry/fit_primitives.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> tilted_disk(double sigma_mm) {
  const Vector3d normal = Vector3d(0.2, -0.3, 1.0).normalized();
  const Vector3d along = normal.unitOrthogonal();
  const Vector3d across = normal.cross(along);
  std::vector<Vector3d> points;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double radius = 30.0 * std::sqrt(uniform_from(hash(11, i)));
    const double turn = kTwoPi * uniform_from(hash(12, i));
    points.emplace_back(Vector3d(400.0, -80.0, 1200.0) + radius * std::cos(turn) * along +
                        radius * std::sin(turn) * across +
                        sigma_mm * normal_from(hash(13, i)) * normal);
  }
  return points;
}

TEST(FitPlane, FindsThePlaneOfExactPointsFarFromTheOrigin) {
  const auto plane = fit_plane(tilted_disk(0.0));
  EXPECT_NEAR(std::abs(plane.normal().dot(Vector3d(0.2, -0.3, 1.0).normalized())), 1.0, 1e-14);
  EXPECT_NEAR(plane.absDistance(Vector3d(400.0, -80.0, 1200.0)), 0.0, 1e-9);
}

TEST(FitPlane, IsAsCertainAsItsPointsAllow) {
  constexpr double kSigma = 0.1;
  const auto plane = fit_plane(tilted_disk(kSigma));
  // The centroid's height: sigma / sqrt(n); a tilt: sigma / (RMS radius along one axis x sqrt(n)).
  const double height = plane.absDistance(Vector3d(400.0, -80.0, 1200.0));
  EXPECT_LT(height, 4.0 * kSigma / std::sqrt(4000.0));
  const double tilt = plane.normal().cross(Vector3d(0.2, -0.3, 1.0).normalized()).norm();
  EXPECT_LT(tilt, 4.0 * kSigma / (15.0 * std::sqrt(4000.0)));
  EXPECT_GT(tilt, 0.0);
}

}  // namespace
}  // namespace frangia
