#include "frangia/registration/find_background.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::Shape;

constexpr double kDistance_mm = 400.0;

CameraModel wide_camera() {
  return testing::small_camera_model(110, 220.0);
}

/// The half space behind a plane at a distance from the axis, opposite of the camera of view 0.
Shape still_wall(double distance_mm) {
  return [=](const Eigen::Vector3d& p) { return p.x() + distance_mm; };
}

/// A vertical pole.
Shape still_pole(double x_mm, double y_mm, double radius_mm) {
  return
      [=](const Eigen::Vector3d& p) { return std::hypot(p.x() - x_mm, p.y() - y_mm) - radius_mm; };
}

/// A shaft with a step.
double stepped_shaft(const Eigen::Vector3d& p) {
  const double radius_mm = p.head<2>().norm();
  return std::min(std::max(radius_mm - 25.0, std::abs(p.z() + 12.0) - 14.0),
                  std::max(radius_mm - 15.0, std::abs(p.z() - 12.0) - 18.0));
}

/// A prism that looks the same after each sixth of a turn.
double six_sided(const Eigen::Vector3d& p) {
  double out = std::abs(p.z()) - 20.0;
  for (int i = 0; i < 3; ++i) {
    const double turn = kTwoPi * i / 6;
    out = std::max(out, std::abs(p.x() * std::cos(turn) + p.y() * std::sin(turn)) - 30.0);
  }
  return out;
}

/// Nothing anywhere.
double nothing_there(const Eigen::Vector3d& /*p*/) {
  return 1e3;
}

std::vector<Eigen::Isometry3d> table_turns(int count, double step_rad) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(testing::look_from(step_rad * i, 0.3, kDistance_mm));
  return poses;
}

struct StillScene {
  Shape part;
  Shape still;  ///< in the object frame of view 0
};

/// A part that turns by `truth`, in front of what stands still, stated to turn by `stated`.
ViewStore views_before(const StillScene& scene,
                       const std::vector<Eigen::Isometry3d>& truth,
                       const std::vector<Eigen::Isometry3d>& stated) {
  ViewStore store;
  testing::Snapshot how{.far_mm = 900.0};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Isometry3d first_from_this = truth.front().inverse() * truth[i];
    const Shape all = [&](const Eigen::Vector3d& p) {
      return std::min(scene.part(p), scene.still(first_from_this * p));
    };
    View view = testing::snapshot(all, wide_camera(), truth[i], how);
    view.rig_from_object = stated[i];
    store.add(view);
    ++how.seed;
  }
  return store;
}

ViewStore views_before(const StillScene& scene, const std::vector<Eigen::Isometry3d>& poses) {
  return views_before(scene, poses, poses);
}

Background background_of(const ViewStore& views) {
  return find_background(views, wide_camera(), std::vector<int>(views.size(), 0));
}

struct LeftPoints {
  std::size_t of_part = 0;
  std::size_t lost_of_part = 0;
  std::size_t of_background = 0;
};

/// What clipping the background leaves, by where the points are.
LeftPoints left_by_clipping(ViewStore& views, const Shape& part) {
  std::vector<View> before;
  for (std::size_t i = 0; i < views.size(); ++i)
    before.push_back(views.load(i));
  clip_background(views, wide_camera());
  const auto rays = rays_of(wide_camera());
  LeftPoints left;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Image<float> after_mm = views.load_depth_mm(i);
    const Eigen::Isometry3d object_from_rig = before[i].rig_from_object.inverse();
    for (int y = 0; y < after_mm.height(); ++y) {
      for (int x = 0; x < after_mm.width(); ++x) {
        const float depth_mm = before[i].range.depth_mm(x, y);
        if (std::isnan(depth_mm)) continue;
        const Eigen::Vector3d point = object_from_rig * (static_cast<double>(depth_mm) *
                                                         rays(x, y).cast<double>().homogeneous());
        const bool on_part = part(point) < 0.5;
        const bool is_left = !std::isnan(after_mm(x, y));
        left.of_part += on_part && is_left ? 1U : 0U;
        left.lost_of_part += on_part && !is_left ? 1U : 0U;
        left.of_background += !on_part && is_left ? 1U : 0U;
      }
    }
  }
  return left;
}

TEST(FindBackground, FindsAWallAndKeepsThePart) {
  ViewStore views = views_before({testing::lumpy, still_wall(120.0)}, table_turns(8, kTwoPi / 8));
  const Background found = background_of(views);
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(found.from_axis_mm, 120.0, 1.0);
  const LeftPoints left = left_by_clipping(views, testing::lumpy);
  EXPECT_EQ(left.lost_of_part, 0U);
  EXPECT_GT(left.of_part, 5000U);
  EXPECT_LT(left.of_background, 60U);
}

TEST(FindBackground, FindsNoneAboutAPartAlone) {
  for (const Shape& part : {Shape(testing::lumpy), Shape(stepped_shaft), Shape(six_sided)}) {
    ViewStore views = views_before({part, nothing_there}, table_turns(6, kTwoPi / 6));
    EXPECT_FALSE(background_of(views).found());
  }
}

TEST(FindBackground, KeepsAPartThatLooksTheSameInAllViews) {
  for (const Shape& part : {Shape(stepped_shaft), Shape(six_sided)}) {
    ViewStore views = views_before({part, still_wall(120.0)}, table_turns(6, kTwoPi / 6));
    const LeftPoints left = left_by_clipping(views, part);
    EXPECT_EQ(left.lost_of_part, 0U);
    EXPECT_GT(left.of_part, 3000U);
    EXPECT_LT(left.of_background, 60U);
  }
}

TEST(FindBackground, KeepsAShaftWhoseAxisIsFourMillimetresOff) {
  const auto truth = table_turns(8, kTwoPi / 8);
  auto stated = truth;
  for (Eigen::Isometry3d& pose : stated)
    pose.translation() += Eigen::Vector3d(4.0, 0.0, 0.0);
  ViewStore views = views_before({stepped_shaft, still_wall(120.0)}, truth, stated);
  const Shape around_shaft = [&](const Eigen::Vector3d& p) { return p.head<2>().norm() - 32.0; };
  const LeftPoints left = left_by_clipping(views, around_shaft);
  EXPECT_EQ(left.lost_of_part, 0U);
  EXPECT_LT(left.of_background, 60U);
}

TEST(FindBackground, FindsAPieceOfWallInTheShadowOfARing) {
  // What is seen of the wall through a ring is no part of the surface around the ring.
  const Shape ring = [](const Eigen::Vector3d& p) {
    return std::hypot(p.head<2>().norm() - 40.0, p.z()) - 9.0;
  };
  ViewStore views = views_before({ring, still_wall(120.0)}, table_turns(8, kTwoPi / 8));
  const LeftPoints left = left_by_clipping(views, ring);
  EXPECT_EQ(left.lost_of_part, 0U);
  EXPECT_LT(left.of_background, 60U);
}

TEST(FindBackground, FindsAPoleBesideThePart) {
  ViewStore views =
      views_before({testing::lumpy, still_pole(5.0, 60.0, 6.0)}, table_turns(8, kTwoPi / 8));
  const Background found = background_of(views);
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(found.from_axis_mm, 55.0, 2.0);
  const LeftPoints left = left_by_clipping(views, testing::lumpy);
  EXPECT_EQ(left.lost_of_part, 0U);
}

/// Points of the lumpy part that clipping the background of such a scan removes, though the table
/// stood otherwise than stated.
std::size_t lost_of_moving_part(const std::vector<Eigen::Isometry3d>& truth,
                                const std::vector<Eigen::Isometry3d>& stated) {
  ViewStore views = views_before({testing::lumpy, still_wall(120.0)}, truth, stated);
  clip_background(views, wide_camera());
  std::size_t lost = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View part = testing::snapshot(testing::lumpy, wide_camera(), truth[i], {.far_mm = 900.0});
    const Image<float> after_mm = views.load_depth_mm(i);
    for (int y = 0; y < after_mm.height(); ++y) {
      for (int x = 0; x < after_mm.width(); ++x)
        lost += !std::isnan(part.range.depth_mm(x, y)) && std::isnan(after_mm(x, y)) ? 1U : 0U;
    }
  }
  return lost;
}

TEST(FindBackground, KeepsAPartWhoseTableStoodStillForHalfOfTheViews) {
  const auto stated = table_turns(8, kTwoPi / 8);
  auto truth = stated;
  for (std::size_t i = 5; i < 8; ++i)
    truth[i] = truth[4];
  EXPECT_EQ(lost_of_moving_part(truth, stated), 0U);
}

TEST(FindBackground, KeepsAPartThatNeverTurned) {
  const auto stated = table_turns(6, kTwoPi / 6);
  const std::vector<Eigen::Isometry3d> truth(6, stated.front());
  EXPECT_FALSE(background_of(views_before({testing::lumpy, nothing_there}, truth, stated)).found());
  EXPECT_EQ(lost_of_moving_part(truth, stated), 0U);
}

TEST(FindBackground, DecidesNothingOfOneAngle) {
  const auto poses = table_turns(1, 0.0);
  ViewStore views = views_before({testing::lumpy, still_wall(120.0)}, {poses[0], poses[0]});
  EXPECT_FALSE(background_of(views).found());
}

TEST(FindBackground, FindsAFarWallThatWouldTurnOutOfTheFieldOfView) {
  for (const int count : {3, 5, 8, 12, 24}) {
    ViewStore views =
        views_before({testing::lumpy, still_wall(400.0)}, table_turns(count, kTwoPi / count));
    const Background found = background_of(views);
    ASSERT_TRUE(found.found()) << count;
    EXPECT_GT(found.from_axis_mm, 380.0) << count;
    remove_background(views, wide_camera(), found);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const View view = views.load(i);
      for (const float depth_mm : view.range.depth_mm.pixels())
        EXPECT_FALSE(depth_mm > 600.0F) << count;
    }
  }
}

TEST(FindBackground, TellsWhatTwoViewsDoNotDecide) {
  const Background found = background_of(
      views_before({testing::lumpy, still_pole(75.0, 20.0, 4.0)}, table_turns(2, kTwoPi / 4)));
  EXPECT_FALSE(found.found());
  EXPECT_GT(found.undecided, 0.1);
}

TEST(FindBackground, FindsInOneSetupWhatStandsStillInAnother) {
  const Shape still = still_wall(120.0);
  ViewStore views = views_before({testing::lumpy, still}, table_turns(6, kTwoPi / 6));
  const Shape turned = [](const Eigen::Vector3d& p) {
    return testing::lumpy(Eigen::Vector3d(p.x(), -p.z(), p.y()));
  };
  views.add(views_before({turned, still}, table_turns(1, 0.0)).load(0));
  const Background found =
      find_background(views, wide_camera(), std::vector<int>{0, 0, 0, 0, 0, 0, 1});
  const std::size_t removed = remove_background(views, wide_camera(), found);
  EXPECT_GT(removed, 0U);
  const auto rays = rays_of(wide_camera());
  const View alone = views.load(6);
  for (int y = 0; y < alone.range.depth_mm.height(); y += 3) {
    for (int x = 0; x < alone.range.depth_mm.width(); x += 3) {
      if (std::isnan(alone.range.depth_mm(x, y))) continue;
      const Eigen::Vector3d point =
          alone.rig_from_object.inverse() * (static_cast<double>(alone.range.depth_mm(x, y)) *
                                             rays(x, y).cast<double>().homogeneous());
      EXPECT_LT(point.head<2>().norm(), 60.0);
    }
  }
}

}  // namespace
}  // namespace frangia
