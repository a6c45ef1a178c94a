// The truth is the plane on which each site was computed.
#include "frangia/calibrate/board/select_plane.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/random.h"

namespace frangia {
namespace {

/// Tangent of the angle under which an axis at (300, 0, 0) along y sees the point of a plane.
double light_on(const Eigen::Vector2d& ray, const Eigen::Vector3d& normal, double distance_mm) {
  const Eigen::Vector3d direction = ray.homogeneous();
  const Eigen::Vector3d point = direction * (distance_mm / normal.dot(direction));
  return (point.x() - 300.0) / point.z();
}

TEST(SelectPlane, FindsTheLargerOfTwoPlanes) {
  const Eigen::Vector3d wall = Eigen::Vector3d(0.3, 0.1, 1.0).normalized();
  const Eigen::Vector3d table = Eigen::Vector3d(0.05, 1.0, 0.5).normalized();
  std::vector<Eigen::Vector2d> rays;
  std::vector<double> light;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 30; ++x) {
      rays.emplace_back(0.01 * (x - 15), 0.01 * (y - 15));
      const auto noise = 1e-4 * normal_from(hash(1, static_cast<std::uint64_t>(30 * y + x)));
      light.push_back(noise + (y < 20 ? light_on(rays.back(), wall, 480.0)
                                      : light_on(rays.back(), table, 300.0)));
    }
  }
  light[17] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<bool> flags = select_plane(rays, light);
  int right = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (flags[i]) ++(i < 600 ? right : wrong);
  EXPECT_GE(right, 595);
  EXPECT_LE(wrong, 15);  // where the planes meet
  EXPECT_FALSE(flags[17]);
}

TEST(SelectPlane, FindsNoneAmongTooFewSites) {
  const std::vector<Eigen::Vector2d> rays(8, Eigen::Vector2d(0.1, 0.2));
  const std::vector<double> light(8, 0.5);
  for (const bool flag : select_plane(rays, light))
    EXPECT_FALSE(flag);
}

}  // namespace
}  // namespace frangia
