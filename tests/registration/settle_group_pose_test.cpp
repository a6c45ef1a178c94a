#include "frangia/registration/settle_group_pose.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/pose_contradictions.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::around_table;
using testing::Shape;

/// A round bar along z with a collar.
double bar(const Eigen::Vector3d& p) {
  const double beside = std::hypot(p.x(), p.y());
  const double shaft = std::max(beside - 16.0, std::abs(p.z()) - 30.0);
  const double collar = std::max(beside - 20.0, std::abs(p.z() + 12.0) - 5.0);
  return 0.8 * std::min(shaft, collar);
}

/// The same with a slot in its side x > 0.
double slotted(const Eigen::Vector3d& p) {
  const Eigen::Array3d out =
      (p - Eigen::Vector3d(18.0, 0.0, 10.0)).array().abs() - Eigen::Array3d(8.0, 7.0, 13.0);
  const double slot = out.max(0.0).matrix().norm() + std::min(out.maxCoeff(), 0.0);
  return 0.8 * std::max(bar(p), -slot);
}

/// A part seen all around from above in two setups.
struct Sides {
  CameraModel camera = testing::small_camera_model(200, 1000.0);
  FastCameraModel model{camera};
  std::vector<SurfelMap> maps;
  std::vector<ViewGroup> groups;
  double spacing_mm = 0.0;

  explicit Sides(const Shape& shape) {
    std::vector<std::vector<ViewGroup::Member>> members(2);
    ViewStore views;
    for (const double latitude_rad : {0.6, 0.45}) {
      for (const Eigen::Isometry3d& pose : around_table(5, latitude_rad, 650.0)) {
        members[latitude_rad > 0.5 ? 0 : 1].push_back({views.size(), pose});
        views.add(testing::snapshot(
            shape, camera, pose, {.seed = static_cast<std::uint32_t>(views.size() + 1)}));
      }
    }
    maps = make_surfel_maps(views, camera, 40000);
    spacing_mm = spacing_for(members, maps);
    for (auto& own : members)
      groups.push_back(make_group(std::move(own), maps, spacing_mm));
  }
  [[nodiscard]] GroupViews views() const { return {maps, model}; }
  [[nodiscard]] SettledPose settled(double turned_deg, double prior_mm) const {
    const Eigen::Isometry3d start(
        Eigen::AngleAxisd(rad_from_deg(turned_deg), Eigen::Vector3d::UnitZ()));
    return settle_group_pose(
        groups[0], groups[1], start, views(), {.spacing_mm = spacing_mm, .prior_mm = prior_mm});
  }
};

double turned_deg(const Eigen::Isometry3d& pose) {
  return deg_from_rad(std::atan2(pose(1, 0), pose(0, 0)));
}

TEST(SettleGroupPose, TurnsARoundPartUntilItsSlotFits) {
  const Sides sides(slotted);
  for (const double off_deg : {7.0, -160.0}) {
    const SettledPose found = sides.settled(off_deg, 1e9);
    EXPECT_NEAR(turned_deg(found.to_from), 0.0, 0.4) << off_deg;
    EXPECT_GT(found.log_odds, 4.605) << off_deg;
    EXPECT_GT(found.moved_mm, 0.5) << off_deg;
    EXPECT_TRUE(found.open.empty()) << off_deg;
  }
}

TEST(SettleGroupPose, KeepsAPoseThatIsStatedFarBetterThanTheSlotIsAway) {
  const SettledPose found = Sides(slotted).settled(-160.0, 0.5);
  EXPECT_LT(found.moved_mm, 5.0);
}

TEST(SettleGroupPose, KeepsAPoseThatFits) {
  const SettledPose found = Sides(slotted).settled(0.0, 1e9);
  EXPECT_EQ(found.moved_mm, 0.0);
  EXPECT_TRUE(found.open.empty());
  ASSERT_EQ(found.held.size(), 1U);  // the distances hardly show the turn, the slot does
  EXPECT_TRUE(found.held[0].turns);
  EXPECT_LT(found.held[0].spread_mm, 0.3);
}

TEST(SettleGroupPose, LeavesOpenHowARoundPartIsTurned) {
  const Sides sides(bar);
  const SettledPose found = sides.settled(20.0, 3.0);
  EXPECT_EQ(found.moved_mm, 0.0);
  ASSERT_EQ(found.open.size(), 1U);
  EXPECT_TRUE(found.open[0].turns);
  EXPECT_GT(std::abs(found.open[0].axis.z()), 0.99);
  EXPECT_NEAR(found.open[0].spread_mm, 3.0, 1.0);  // what is stated
  // The motion is a turn about the axis of the bar.
  const Eigen::Vector3d turn = found.open[0].motion.head<3>();
  const Eigen::Vector3d shift = found.open[0].motion.tail<3>();
  EXPECT_LT(shift.norm(), 0.02 * turn.norm() * 16.0);
}

TEST(SettleGroupPose, HasNothingToSettleWhereTheShapeHolds) {
  const SettledPose found = Sides(testing::lumpy).settled(0.0, 1e9);
  EXPECT_EQ(found.moved_mm, 0.0);
  EXPECT_TRUE(found.open.empty());
}

TEST(PoseContradictions, AreFewInARightPoseAndManyWhereASlotIsElsewhere) {
  const Sides sides(slotted);
  const Eigen::Isometry3d right = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d wrong(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const PoseContradictions contradictions(
      sides.groups[0], sides.groups[1], sides.views(), sides.spacing_mm, right);
  const PatchCount few = contradictions.count(right);
  const PatchCount many = contradictions.count(wrong);
  EXPECT_GT(few.compared, 300U);
  EXPECT_LT(few.contradicting, few.compared / 50);
  EXPECT_GT(many.contradicting, few.contradicting + 20);
  EXPECT_GT(log_odds_of(few, many), 4.605);
  EXPECT_LT(log_odds_of(many, few), -4.605);
}

}  // namespace
}  // namespace frangia
