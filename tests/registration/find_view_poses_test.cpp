#include "frangia/registration/find_view_poses.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/random.h"
#include "frangia/local_fit/surfel_map.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::around_table;
using testing::lumpy;
using testing::Shape;
using testing::small_camera_model;

double vase(const Eigen::Vector3d& p) {
  const double wide = 25.0 + 4.0 * std::sin(0.12 * p.z());
  return 0.8 * std::max(std::hypot(p.x(), p.y()) - wide, std::abs(p.z()) - 30.0);
}

double ellipsoid(const Eigen::Vector3d& p) {
  const Eigen::Array3d half_mm(38.0, 26.0, 18.0);
  return 6.0 * ((p.array() / half_mm).matrix().norm() - 1.0);
}

double block(const Eigen::Vector3d& p) {
  const Eigen::Array3d beyond_mm = p.array().abs() - Eigen::Array3d(38.0, 26.0, 18.0);
  return 0.8 * (beyond_mm.max(0.0).matrix().norm() + std::min(beyond_mm.maxCoeff(), 0.0));
}

/// Views with unknown poses: each is in a frame of its own.
struct Lost {
  CameraModel camera = small_camera_model(200, 1000.0);
  std::vector<Eigen::Isometry3d> truth;
  ViewStore views;
  std::vector<std::string> names;
  std::vector<std::string> warnings;

  Lost(const Shape& shape, std::vector<Eigen::Isometry3d> poses) : truth(std::move(poses)) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      // An unknown rotation about the line of sight, as of a scanner that is held by hand.
      truth[i].linear() =
          Eigen::AngleAxisd(kTwoPi * uniform_from(hash(7, i)), Eigen::Vector3d::UnitZ()) *
          truth[i].linear();
      views.add(
          testing::snapshot(shape, camera, truth[i], {.seed = static_cast<std::uint32_t>(i + 1)}));
      views.set_rig_from_object(i, Eigen::Isometry3d::Identity());
      names.push_back("scan-" + std::to_string(i) + ".ply");
    }
  }
  FoundPoses find_poses() {
    Run run;
    run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
    auto maps = make_surfel_maps(views, camera, 40000);
    return find_view_poses(views, maps, camera, names, run);
  }
  /// Displacement of the part's centre, plus its rotation as an arc at 38 mm.
  [[nodiscard]] double off_mm(std::size_t i, std::size_t reference) const {
    const Eigen::Isometry3d wanted = truth[i] * truth[reference].inverse();
    const Eigen::Isometry3d got =
        views.rig_from_object(i) * views.rig_from_object(reference).inverse();
    const Eigen::Isometry3d off = wanted.inverse() * got;
    const Eigen::Vector3d middle = truth[reference].translation();
    return (off * middle - middle).norm() + 38.0 * Eigen::AngleAxisd(off.rotation()).angle();
  }
  [[nodiscard]] bool empty(std::size_t i) const {
    const View view = views.load(i);
    const auto depth = view.range.depth_mm.pixels();
    return std::all_of(depth.begin(), depth.end(), [](float z) { return std::isnan(z); });
  }
};

TEST(FindViewPoses, FindsUnknownPoses) {
  Lost lost(lumpy, around_table(6, 0.3, 650.0));
  const FoundPoses found = lost.find_poses();
  EXPECT_EQ(found.found, 6U);
  EXPECT_TRUE(lost.warnings.empty()) << lost.warnings.front();
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT(lost.off_mm(i, found.reference), 0.1) << i;
}

TEST(FindViewPoses, NamesAndEmptiesAViewThatOverlapsNoOther) {
  auto poses = around_table(3, 0.3, 650.0);
  poses[1] = around_table(12, 0.3, 650.0)[1];
  poses[2] = around_table(12, 0.3, 650.0)[7];  // sees the other side
  Lost lost(lumpy, poses);
  const FoundPoses found = lost.find_poses();
  ASSERT_EQ(found.left_out, std::vector<std::size_t>{2});
  ASSERT_EQ(lost.warnings.size(), 1U);
  EXPECT_NE(lost.warnings[0].find("scan-2.ply"), std::string::npos) << lost.warnings[0];
  EXPECT_TRUE(lost.empty(2));
  EXPECT_LT(lost.off_mm(1, 0), 0.1);
}

TEST(FindViewPoses, ChoosesNoPoseForARoundPart) {
  Lost lost(vase, around_table(4, 0.3, 650.0));
  try {
    static_cast<void>(lost.find_poses());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    EXPECT_NE(std::string(error.what()).find("look alike"), std::string::npos) << error.what();
  }
}

TEST(FindViewPoses, LeavesOutTheSecondOfTwoViewsThatLookTheSame) {
  const auto poses = around_table(6, 0.3, 650.0);
  Lost again(lumpy, {poses[0], poses[1], poses[0]});
  EXPECT_EQ(again.find_poses().left_out, std::vector<std::size_t>{2});
  ASSERT_EQ(again.warnings.size(), 1U);
  EXPECT_NE(again.warnings[0].find("scan-2.ply: looks the same as scan-0.ply"), std::string::npos)
      << again.warnings[0];
}

TEST(FindViewPoses, JoinsNoTwoSidesOfASymmetricPart) {
  Lost lost(ellipsoid, around_table(8, 0.3, 650.0));
  const FoundPoses found = lost.find_poses();
  for (const std::size_t half : {4U, 5U, 6U, 7U})  // as 0, 1, 2, 3 from the other side
    EXPECT_TRUE(lost.empty(half)) << half;
  for (std::size_t i = 0; i < 4; ++i) {
    if (lost.empty(i)) continue;
    const double off_mm = lost.off_mm(i, found.reference);  // 0, or half a turn of the part
    EXPECT_LT(std::min(off_mm, std::abs(off_mm - 38.0 * 0.5 * kTwoPi)), 0.3) << i;
  }
}

TEST(FindViewPoses, ChoosesNoPoseForTwoSidesOfABlockThatSlideOnEachOther) {
  const auto poses = around_table(6, 0.3, 650.0);
  Lost lost(block, {poses[1], poses[2]});  // a wrong edge fits better than the face they share
  EXPECT_THROW(static_cast<void>(lost.find_poses()), Error);
}

TEST(FindViewPoses, GivesTheSameForAnyNumberOfThreads) {
  const auto find = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Lost lost(lumpy, {around_table(6, 0.3, 650.0)[0], around_table(6, 0.3, 650.0)[1]});
    static_cast<void>(lost.find_poses());
    return lost.views.rig_from_object(1).matrix();
  };
  EXPECT_EQ(find(1), find(2));
}

TEST(ArePosesPlausible, DistinguishesASharedFrameFromUnrelatedOnes) {
  Lost lost(lumpy, around_table(4, 0.3, 650.0));
  const auto maps = make_surfel_maps(lost.views, lost.camera, 40000);
  EXPECT_FALSE(are_poses_plausible(lost.views, maps, lost.camera, 3.0));
  for (std::size_t i = 0; i < 4; ++i)
    lost.views.set_rig_from_object(i, lost.truth[i]);
  EXPECT_TRUE(are_poses_plausible(lost.views, maps, lost.camera, 3.0));
}

}  // namespace
}  // namespace frangia
