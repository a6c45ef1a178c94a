#include "frangia/reconstruct/internal/register_setups.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/internal/points_of_setups.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/analytic_views.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::lumpy;
using testing::Shape;
using testing::small_camera_model;
using testing::TemporaryFolder;

/// A part on a table that a camera looks down on, in several setups.
struct Setups {
  Rig rig;
  std::vector<MeasuredSetup> setups;
  std::vector<std::string> warnings;
  Run run;

  Setups() {
    rig.reference().model = small_camera_model(160, 800.0);
    rig.turntable = Turntable{{2.0, 8.0, 650.0}, Eigen::Vector3d(0.03, -0.9, -0.4).normalized()};
    run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  }
  void add_setup(const Shape& shape, const Eigen::Isometry3d& part_pose) {
    constexpr int kViews = 5;
    MeasuredSetup setup{static_cast<int>(setups.size()), {}, {}};
    const Eigen::Isometry3d back = part_pose.inverse();
    for (int i = 0; i < kViews; ++i) {
      const double angle_rad = kTwoPi * i / kViews;
      setup.measured.reference().add(
          testing::snapshot([&](const Eigen::Vector3d& p) { return shape(back * p); },
                            rig.reference().model,
                            rig.rig_from_object(angle_rad),
                            {.seed = static_cast<std::uint32_t>(10 * setup.number + i + 1)}));
      setup.measured.stations.push_back({angle_rad, "views/" + std::to_string(i), 0});
    }
    setups.push_back(std::move(setup));
  }
};

Eigen::Isometry3d turned_over() {
  Eigen::Isometry3d part_pose = Eigen::Isometry3d::Identity();
  part_pose.linear() = (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(2.9, Eigen::Vector3d::UnitX()))
                           .toRotationMatrix();
  part_pose.translation() = Eigen::Vector3d(3.0, -2.0, 4.0);
  return part_pose;
}

void expect_near(const Eigen::Isometry3d& found,
                 const Eigen::Isometry3d& wanted,
                 double near_mm = 0.02) {
  const Eigen::Isometry3d off = wanted.inverse() * found;
  EXPECT_LT(off.translation().norm(), near_mm);
  EXPECT_LT(Eigen::AngleAxisd(off.rotation()).angle(), rad_from_deg(0.05));
}

TEST(RegisterSetups, FindsHowThePartWasTurnedOver) {
  Setups all;
  all.add_setup(lumpy, Eigen::Isometry3d::Identity());
  all.add_setup(lumpy, turned_over());
  const MeasuredSetup joined = register_setups(std::move(all.setups), all.rig, {}, all.run);
  EXPECT_TRUE(all.warnings.empty()) << all.warnings.front();
  ASSERT_TRUE(joined.registration.has_value());
  EXPECT_EQ(joined.measured.reference().size(), 10U);
  ASSERT_EQ(joined.registration->part_poses.size(), 1U);
  expect_near(joined.registration->part_poses[0], turned_over());
  EXPECT_LT(joined.registration->rms_after_mm, 0.035);
  ASSERT_EQ(joined.joins.size(), 2U);
  EXPECT_TRUE(std::isnan(joined.joins[0].overlap));
  EXPECT_TRUE(joined.joins[1].joined);
  EXPECT_EQ(joined.joins[1].number, 1);
  EXPECT_EQ(joined.joins[1].views, 5U);
  EXPECT_GT(joined.joins[1].overlap, 0.3);
  EXPECT_LT(joined.joins[1].free_space_violation, 0.015);
  expect_near(joined.joins[1].part_pose, turned_over());
  // Each cloud lies on the part: a point of one has a point of the other nearby where both saw it.
  const auto clouds = points_of_setups(joined, all.rig, 3000);
  ASSERT_EQ(clouds.size(), 2U);
  for (const PointCloud& cloud : clouds) {
    EXPECT_GT(cloud.points_mm.size(), 1000U);
    EXPECT_LT(cloud.points_mm.size(), 12'000U);
    double worst_mm = 0.0;
    for (const Eigen::Vector3f& point : cloud.points_mm)
      worst_mm = std::max(worst_mm, std::abs(lumpy(point.cast<double>())));
    EXPECT_LT(worst_mm, 1.0);
  }
}

/// A bar of L-shaped section, standing, with one dent that tells how high it stands.
double angle_bar(const Eigen::Vector3d& p) {
  const auto beyond = [&](const Eigen::Array3d& middle, const Eigen::Array3d& half) {
    const Eigen::Array3d d = (p.array() - middle).abs() - half;
    return d.max(0.0).matrix().norm() + std::min(d.maxCoeff(), 0.0);
  };
  const double walls = std::min(beyond({0.0, -15.0, 0.0}, {25.0, 5.0, 20.0}),
                                beyond({-20.0, 0.0, 0.0}, {5, 20, 20}));
  const double dent = 6.0 - (p - Eigen::Vector3d(8.0, -23.0, 3.0)).norm();
  return 0.8 * std::max(walls, dent);
}

TEST(RegisterSetups, FindsTheWayUpOfAPartWhoseWallsSlideOnEachOtherButForADent) {
  Eigen::Isometry3d upside_down = Eigen::Isometry3d::Identity();
  upside_down.rotate(Eigen::AngleAxisd(0.5 * kTwoPi, Eigen::Vector3d::UnitX()));
  Setups all;
  all.add_setup(angle_bar, Eigen::Isometry3d::Identity());
  all.add_setup(angle_bar, upside_down);
  const MeasuredSetup joined = register_setups(std::move(all.setups), all.rig, {}, all.run);
  EXPECT_TRUE(all.warnings.empty()) << all.warnings.front();
  ASSERT_EQ(joined.registration->part_poses.size(), 1U);
  expect_near(joined.registration->part_poses[0], upside_down, 0.1);  // a dent alone
}

/// A turned part: a round bar with a collar, the same from all sides.
double turned_bar(const Eigen::Vector3d& p) {
  const double beside = std::hypot(p.x(), p.y());
  const double bar = std::max(beside - 16.0, std::abs(p.z()) - 30.0);
  const double collar = std::max(beside - 22.0, std::abs(p.z() + 12.0) - 6.0);
  return 0.8 * std::min(bar, collar);
}

TEST(RegisterSetups, JoinsARoundPartOfWhichAnyTurnFitsAndSaysSo) {
  Eigen::Isometry3d laid_down = Eigen::Isometry3d::Identity();
  laid_down.rotate(Eigen::AngleAxisd(0.25 * kTwoPi, Eigen::Vector3d::UnitX()));
  Setups all;
  all.add_setup(turned_bar, Eigen::Isometry3d::Identity());
  all.add_setup(turned_bar, laid_down);
  const MeasuredSetup joined = register_setups(std::move(all.setups), all.rig, {}, all.run);
  ASSERT_EQ(joined.joins.size(), 2U);
  ASSERT_TRUE(joined.joins[1].joined);
  EXPECT_EQ(joined.measured.reference().size(), 10U);
  ASSERT_EQ(joined.joins[1].open.size(), 1U);
  EXPECT_NE(joined.joins[1].open[0].find("its turn about the axis"), std::string::npos);
  // The axis is where it belongs.
  const Eigen::Isometry3d off = laid_down.inverse() * joined.joins[1].part_pose;
  for (const double z : {-30.0, 30.0}) {
    const Eigen::Vector3d on_axis(0.0, 0.0, z);
    EXPECT_LT((off * on_axis - on_axis).norm(), 0.1) << z;
  }
}

TEST(RegisterSetups, StartsFromARoughPartPoseThatIsGiven) {
  Setups all;
  all.add_setup(lumpy, Eigen::Isometry3d::Identity());
  all.add_setup(lumpy, turned_over());
  Eigen::Isometry3d rough = turned_over();
  rough.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY()));
  rough.translation().x() += 1.5;
  RegisterSetupsOptions options;
  options.part_poses[1] = rough;
  const MeasuredSetup joined = register_setups(std::move(all.setups), all.rig, options, all.run);
  ASSERT_EQ(joined.registration->part_poses.size(), 1U);
  expect_near(joined.registration->part_poses[0], turned_over());
}

TEST(RegisterSetups, NamesASetupThatFitsNoOtherAndLeavesItOut) {
  Setups all;
  all.add_setup(lumpy, Eigen::Isometry3d::Identity());
  all.add_setup(testing::box({30.0, 18.0, 22.0}), Eigen::Isometry3d::Identity());
  const MeasuredSetup joined = register_setups(std::move(all.setups), all.rig, {}, all.run);
  ASSERT_EQ(all.warnings.size(), 1U);
  EXPECT_NE(all.warnings[0].find("setup 1 (views/0 to views/4)"), std::string::npos)
      << all.warnings[0];
  EXPECT_EQ(joined.measured.reference().size(), 5U);
  ASSERT_EQ(joined.joins.size(), 2U);
  EXPECT_TRUE(joined.joins[0].joined);
  EXPECT_FALSE(joined.joins[1].joined);
  EXPECT_EQ(points_of_setups(joined, all.rig, 3000).size(), 1U);
}

TEST(Reconstruct, MeasuresTheBottomOfABracketThatWasLaidDown) {
  const TemporaryFolder folder;
  const TemporaryFolder folder_of_one;
  const Mesh part = make_part("bracket");
  const SimulateOptions mixed{.samples_per_px = 4};  // as a camera's pixels mix an edge
  Scan plan = testing::small_scan(folder_of_one.path(), "bracket", "digital", 6, mixed);
  const RayScene truth(part);
  const double one_rms_mm = surface_error(reconstruct(plan).mesh, truth).rms_mm;
  plan.folder = folder.path();
  for (int i = 0; i < 6; ++i)
    plan.views.push_back({kTwoPi * i / 6, "views/1" + std::to_string(i), 1});
  plan.part_poses[1] = pose_on_table(part, rad_from_deg(90.0), 0.4);
  const Reconstruction result = reconstruct(simulate_scan(part, plan, mixed));
  ASSERT_TRUE(result.registration && result.registration->part_poses.size() == 1);
  EXPECT_LT(surface_error(result.mesh, truth).rms_mm, 1.25 * one_rms_mm);
  const auto below = std::count_if(
      result.mesh.vertices_mm.begin(), result.mesh.vertices_mm.end(), [](const auto& vertex) {
        return std::abs(vertex.z()) < 0.2F && vertex.template head<2>().norm() < 20.0F;
      });
  EXPECT_GT(below, 100);
}

TEST(Reconstruct, SaysOnceThatThePartSlidInOneOfTwoSetups) {
  const TemporaryFolder folder;
  const Mesh part = make_part("bust");
  Scan plan;
  plan.folder = folder.path();
  plan.rig = testing::small_rig("digital", 4);
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < 12; ++i)
    plan.views.push_back({kTwoPi * (i % 6) / 6, "views/" + std::to_string(i), i / 6});
  plan.part_poses[1] = pose_on_table(part, rad_from_deg(180.0), 0.4);
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const SimulateOptions slid{.motion = {.slide_view = 3, .slide_mm = 0.8}};
  static_cast<void>(reconstruct(simulate_scan(part, plan, slid), {}, run));
  const auto said = std::count_if(warnings.begin(), warnings.end(), [](const std::string& one) {
    return one.find("the part slid by 0.8") != std::string::npos;
  });
  EXPECT_EQ(said, 1);
}

}  // namespace
}  // namespace frangia
