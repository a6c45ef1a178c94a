#include "frangia/registration/find_turntable_top.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::Shape;
using testing::small_camera_model;

constexpr double kDistance = 650.0;

/// A turntable with its rim.
Shape disc(double radius_mm, double top_mm) {
  return [=](const Eigen::Vector3d& p) {
    return std::max(p.head<2>().norm() - radius_mm, std::max(p.z() - top_mm, top_mm - 4.0 - p.z()));
  };
}

ViewStore look_at(const Shape& scene) {
  return testing::snapshots(scene, small_camera_model(), testing::around_table(6, 0.6, kDistance));
}

TEST(FindTurntableTop, FindsTheDiscThatThePartStandsOn) {
  const Shape part = testing::box({15.0, 10.0, 12.0}, {3.0, 0.0, 10.0});
  const auto turntable_top =
      find_turntable_top(look_at(testing::both(part, disc(45.0, -2.0))), small_camera_model());
  ASSERT_TRUE(turntable_top);
  EXPECT_NEAR(turntable_top->plane.normal().z(), 1.0, 1e-4);
  EXPECT_NEAR(turntable_top->height_mm(), -2.0, 0.02);
}

TEST(FindTurntableTop, FindsATiltedOne) {
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(rad_from_deg(1.0), Eigen::Vector3d::UnitX()).matrix();
  const Shape scene = [=, flat = disc(45.0, 0.0)](const Eigen::Vector3d& p) {
    return flat(tilt.transpose() * p);
  };
  const auto turntable_top = find_turntable_top(
      look_at(testing::both(scene, testing::sphere(15.0, {0.0, 0.0, 14.0}))), small_camera_model());
  ASSERT_TRUE(turntable_top);
  EXPECT_GT(turntable_top->plane.normal().dot(tilt.col(2)), std::cos(rad_from_deg(0.05)));
}

TEST(FindTurntableTop, IgnoresAFlatPart) {
  const Shape foot = testing::box({30.0, 22.0, 4.0});  // horizontal, at the bottom, not round
  const Shape post = testing::box({8.0, 8.0, 15.0}, {0.0, 0.0, 15.0});
  EXPECT_FALSE(find_turntable_top(look_at(testing::both(foot, post)), small_camera_model()));
}

TEST(FindTurntableTop, IgnoresARoundShelf) {
  const Shape post = testing::box({10.0, 10.0, 20.0});
  EXPECT_FALSE(
      find_turntable_top(look_at(testing::both(disc(30.0, 10.0), post)), small_camera_model()));
}

TEST(FindTurntableTop, IgnoresTheBaseOfABust) {
  const Shape head = testing::sphere(24.0, {0.0, 0.0, 34.0});
  EXPECT_FALSE(
      find_turntable_top(look_at(testing::both(disc(30.0, 8.0), head)), small_camera_model()));
}

TEST(FindTurntableTop, FindsAHighOneThatIsMuchWiderThanThePart) {
  const Shape ball = testing::sphere(12.0, {0.0, 0.0, 20.0});
  EXPECT_TRUE(
      find_turntable_top(look_at(testing::both(disc(45.0, 8.0), ball)), small_camera_model()));
}

TEST(FindTurntableTop, TakesNoWheelThatStandsAtTheOriginForOne) {
  const Shape wheel = [](const Eigen::Vector3d& p) {
    return std::max(p.head<2>().norm() - 32.0, std::max(p.z() - 24.0, -p.z()));
  };
  const Shape hub = testing::box({9.0, 9.0, 4.0}, {0.0, 0.0, 28.0});
  EXPECT_FALSE(find_turntable_top(look_at(testing::both(wheel, hub)), small_camera_model()));
}

/// A camera that looks horizontally: of the turntable it sees only the rim.
ViewStore look_horizontally_at(const Shape& scene) {
  return testing::snapshots(
      scene, small_camera_model(), testing::around_table(6, 0.0, kDistance), {.steepest_rad = 1.4});
}

TEST(FindTurntableTop, FindsTheRimOfOneThatIsSeenEdgeOn) {
  const Shape part = testing::box({15.0, 10.0, 12.0}, {3.0, 0.0, 12.0});
  const auto top = find_turntable_top(look_horizontally_at(testing::both(part, disc(45.0, 0.0))),
                                      small_camera_model());
  ASSERT_TRUE(top);
  EXPECT_TRUE(top->rim_only);
  EXPECT_NEAR(top->height_mm(), 0.0, 0.5);
}

TEST(FindTurntableTop, TakesNoFlangeAboveTheOriginForARim) {
  const Shape post = testing::box({8.0, 8.0, 15.0}, {0.0, 0.0, 27.0});
  EXPECT_FALSE(find_turntable_top(look_horizontally_at(testing::both(post, disc(40.0, 12.0))),
                                  small_camera_model()));
}

TEST(FindTurntableTop, TakesNoFootThatTouchesThePartForARim) {
  const Shape cone = [](const Eigen::Vector3d& p) {
    const double radius = std::max(0.0, 40.0 - p.z());  // from the foot up to a tip
    return 0.6 * std::max({p.head<2>().norm() - radius, p.z() - 38.0, -p.z()});
  };
  const Shape foot = disc(40.0, 0.0);
  EXPECT_FALSE(
      find_turntable_top(look_horizontally_at(testing::both(cone, foot)), small_camera_model()));
}

TEST(FindTurntableTop, TakesNoCylinderWithNothingAboveForARim) {
  EXPECT_FALSE(find_turntable_top(look_horizontally_at(disc(40.0, 0.0)), small_camera_model()));
}

TEST(FindTurntableTop, TakesNoEndOfARodForADisc) {
  const Shape rod = [](const Eigen::Vector3d& p) {
    return std::max(p.head<2>().norm() - 15.0, std::max(p.z() - 40.0, 1.0 - p.z()));
  };
  EXPECT_FALSE(find_turntable_top(look_at(rod), small_camera_model()));
}

TEST(FindTurntableTop, FindsNoneUnderASphere) {
  EXPECT_FALSE(find_turntable_top(look_at(testing::sphere(30.0)), small_camera_model()));
}

}  // namespace
}  // namespace frangia
