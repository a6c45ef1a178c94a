#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/geometry/fit_primitives.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Points of a cap around +z, as in one view of a ball.
std::vector<Vector3d> cap(const Vector3d& center, double radius, double min_cos, double sigma) {
  std::vector<Vector3d> points;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double z = min_cos + (1.0 - min_cos) * uniform_from(hash(1, i));
    const double turn = kTwoPi * uniform_from(hash(2, i));
    const double out = std::sqrt(1.0 - z * z);
    points.emplace_back(center + (radius + sigma * normal_from(hash(3, i))) *
                                     Vector3d(out * std::cos(turn), out * std::sin(turn), z));
  }
  return points;
}

TEST(FitSphere, FindsTheSphereOfExactPoints) {
  const Sphere sphere = fit_sphere(cap({120, -35, 560}, 20.0, 0.2, 0.0));
  EXPECT_NEAR((sphere.center_mm - Vector3d(120, -35, 560)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(sphere.radius_mm, 20.0, 1e-9);
  EXPECT_NEAR(sphere.rms_mm, 0.0, 1e-9);
}

TEST(FitSphere, IsNotBiasedByNoiseOnACap) {
  const Sphere sphere = fit_sphere(cap({1, 2, 3}, 20.0, 0.3, 0.05));
  EXPECT_NEAR(sphere.radius_mm, 20.0, 0.01);
  EXPECT_NEAR((sphere.center_mm - Vector3d(1, 2, 3)).norm(), 0.0, 0.02);
  EXPECT_NEAR(sphere.rms_mm, 0.05, 0.002);
}

TEST(FitSphere, RefusesPlanesAndTooFewPoints) {
  const std::vector<Vector3d> square{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}, {3, 2, 5}};
  EXPECT_THROW(static_cast<void>(fit_sphere(square)), Error);
  const std::vector<Vector3d> three(square.begin(), square.begin() + 3);
  EXPECT_THROW(static_cast<void>(fit_sphere(three)), Error);
  const std::vector<Vector3d> one(7, Vector3d(1, 2, 3));
  EXPECT_THROW(static_cast<void>(fit_sphere(one)), Error);
}

}  // namespace
}  // namespace frangia
