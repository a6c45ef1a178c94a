#include "frangia/registration/compare_groups.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/local_fit/surfel_map.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::around_table;
using testing::lumpy;
using testing::small_camera_model;

constexpr double kSpacing_mm = 1.5;

/// Two neighbouring views of a part, each a group of its own in the object frame.
struct TwoGroups {
  CameraModel camera = small_camera_model(200, 1000.0);
  FastCameraModel model{camera};
  std::vector<SurfelMap> maps;
  ViewGroup to, from;

  explicit TwoGroups(const testing::Shape& shape = lumpy) {
    const auto poses = around_table(8, 0.3, 650.0);
    const ViewStore views = testing::snapshots(shape, camera, {poses[0], poses[1]});
    maps = make_surfel_maps(views, camera, 40000);
    to = make_group({{0, poses[0]}}, maps, kSpacing_mm);
    from = make_group({{1, poses[1]}}, maps, kSpacing_mm);
  }
  [[nodiscard]] GroupFit compare(const Eigen::Isometry3d& to_from, double gate_mm = 0.5) const {
    return compare_groups(to, from, to_from, {maps, model}, gate_mm);
  }
};

Eigen::Isometry3d shifted(const Eigen::Vector3d& by_mm) {
  return Eigen::Isometry3d(Eigen::Translation3d(by_mm));
}

TEST(CompareGroups, FindsOverlapAndNoViolationsInTheTruePose) {
  const TwoGroups groups;
  const GroupFit fit = groups.compare(Eigen::Isometry3d::Identity());
  EXPECT_GT(fit.overlap, 0.5);
  EXPECT_LT(fit.free_space_violation(), 0.01);
  EXPECT_LT(fit.residual_mm, 0.03);
  EXPECT_GT(fit.smallest_eigenvalue, 0.001);
}

TEST(CompareGroups, FindsViolationsWhenAGroupIsMovedTowardsTheCamera) {
  const TwoGroups groups;
  const Eigen::Vector3d towards = around_table(8, 0.3, 650.0)[0].inverse().translation();
  const GroupFit fit = groups.compare(shifted(5.0 * towards.normalized()));
  EXPECT_GT(fit.free_space_violation(), 0.2);
}

TEST(CompareGroups, FindsTheDirectionsThatAPlaneDoesNotDetermine) {
  const TwoGroups groups(testing::box({30.0, 30.0, 8.0}, {0.0, 0.0, -8.0}));
  const auto top_only = [&](const ViewGroup& group) {
    ViewGroup top{group.members, {}};
    for (std::size_t i = 0; i < group.points.size(); ++i) {
      if (group.points.normals[i].z() > 0.9F)
        top.points.add(group.points.points_mm[i], group.points.normals[i]);
    }
    return top;
  };
  const GroupFit fit = compare_groups(top_only(groups.to),
                                      top_only(groups.from),
                                      Eigen::Isometry3d::Identity(),
                                      {groups.maps, groups.model},
                                      0.5);
  EXPECT_LT(fit.smallest_eigenvalue, 1e-4);
  for (int i = 0; i < 2; ++i) {  // shifts within the plane and the rotation in it
    const auto direction = fit.weakest_directions.col(i);
    EXPECT_LT(std::abs(direction[2]) + std::abs(direction[3]) + std::abs(direction[4]), 0.1) << i;
  }
}

TEST(CompareGroups, HasTheGradientOfItsResiduals) {
  const TwoGroups groups;
  // For a wide gate all weights are 1, and the gradient is that of half the sum of squares.
  const GroupFit fit = groups.compare(shifted({0.1, -0.08, 0.12}), 4.0);
  const Eigen::Matrix<double, 6, 1> newton = -fit.information.ldlt().solve(fit.gradient);
  const Eigen::Isometry3d moved = fit.motion(newton) * shifted({0.1, -0.08, 0.12});
  EXPECT_LT(moved.translation().norm(), 0.02);
  EXPECT_LT(Eigen::AngleAxisd(moved.rotation()).angle(), 0.001);
}

TEST(RefineFit, FindsThePoseFromTwoMillimetresAndTwoDegreesAway) {
  const TwoGroups groups;
  Eigen::Isometry3d start = shifted({1.2, -1.0, 1.2});
  start.rotate(Eigen::AngleAxisd(0.035, Eigen::Vector3d(1.0, 1.0, 0.3).normalized()));
  const Eigen::Isometry3d found =
      refine_fit(groups.to, groups.from, start, {groups.maps, groups.model}, {6.0, 0.45});
  EXPECT_LT(found.translation().norm(), 0.03);
  EXPECT_LT(Eigen::AngleAxisd(found.rotation()).angle(), 0.001);
}

TEST(SpacingFor, IsAFiftiethOfTheSizeOfAGroup) {
  const TwoGroups groups;
  const std::vector<std::vector<ViewGroup::Member>> members = {groups.to.members};
  Eigen::AlignedBox3f box;
  for (const auto& point : groups.to.points.points_mm)
    box.extend(point);
  EXPECT_NEAR(
      spacing_for(members, groups.maps), static_cast<double>(box.diagonal().norm()) / 50.0, 0.05);
}

}  // namespace
}  // namespace frangia
