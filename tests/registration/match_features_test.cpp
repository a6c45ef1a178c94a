#include <vector>

#include <gtest/gtest.h>

#include "frangia/registration/internal/find_motion_hypotheses.h"
#include "frangia/registration/internal/surface_features.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

/// Points and normals of the lumpy part all around, by projecting a sphere's points onto it.
SurfacePoints lumpy_points(int count, double phase) {
  SurfacePoints points;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double turn = 2.399963 * i + phase;
    const double across = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d away(across * std::cos(turn), across * std::sin(turn), z);
    const double t = testing::trace(testing::lumpy, 80.0 * away, -away, 80.0);
    if (std::isnan(t)) continue;
    const Eigen::Vector3d hit = (80.0 - t) * away;
    Eigen::Vector3d normal;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = 1e-3 * Eigen::Vector3d::Unit(k);
      normal[k] = testing::lumpy(hit + step) - testing::lumpy(hit - step);
    }
    points.add(hit.cast<float>(), normal.normalized().cast<float>());
  }
  return points;
}

Eigen::Isometry3d far_motion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -1.0, 0.6).normalized()).toRotationMatrix();
  motion.translation() = Eigen::Vector3d(120.0, -40.0, 75.0);
  return motion;
}

SurfacePoints moved(const SurfacePoints& points, const Eigen::Isometry3d& motion) {
  SurfacePoints out;
  out.add(points, motion);
  return out;
}

TEST(MatchFeatures, MatchesEqualColumnsAndNoZeros) {
  Eigen::MatrixXf features = Eigen::MatrixXf::Zero(4, 5);
  for (int i = 0; i < 4; ++i)
    features(i, i) = 1.0F;  // the fifth point has no neighbours
  Eigen::MatrixXf reversed = features;
  for (int i = 0; i < 4; ++i)
    reversed.col(i) = features.col(3 - i);
  const auto matches = match_features(features, reversed, {.distinct = 1.0});
  ASSERT_EQ(matches.size(), 4U);
  for (const FeatureMatch& match : matches)
    EXPECT_EQ(match.from + match.to, 3U);
}

TEST(MatchFeatures, LeavesOutPointsNearTheMeanFeature) {
  Eigen::MatrixXf features = Eigen::MatrixXf::Zero(3, 10);
  features.row(0).setOnes();  // nine points of a flat face
  features.col(7) << 0.0F, 1.0F, 0.0F;
  const auto matches = match_features(features, features, {.distinct = 0.1});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0], (FeatureMatch{7, 7}));
}

TEST(SurfaceFeatures, DoNotDependOnThePose) {
  const SurfacePoints points = lumpy_points(1500, 0.0);
  const Eigen::MatrixXf one = surface_features(points, 10.0);
  const Eigen::MatrixXf other = surface_features(moved(points, far_motion()), 10.0);
  ASSERT_EQ(one.rows(), 33);
  // Rounding moves a few angles across the border of a bin.
  EXPECT_LT((one - other).colwise().norm().mean(), 0.02F);
  EXPECT_GT((one.colwise() - one.rowwise().mean()).colwise().norm().mean(), 0.2F);
}

TEST(SurfaceFeatures, AreZeroForAPointWithoutNeighbours) {
  SurfacePoints points = lumpy_points(1500, 0.0);
  points.add({500.0F, 0.0F, 0.0F}, Eigen::Vector3f::UnitX());
  const Eigen::MatrixXf features = surface_features(points, 10.0);
  EXPECT_EQ(features.rightCols<1>().norm(), 0.0F);
}

TEST(FindMotionHypotheses, FindsTheMotionBetweenTwoSamplingsOfAPart) {
  const SurfacePoints from = lumpy_points(1500, 0.0);
  const SurfacePoints to = moved(lumpy_points(1500, 1.0), far_motion());
  const auto matches = match_features(surface_features(from, 10.0), surface_features(to, 10.0));
  const auto motions = find_motion_hypotheses(from, to, matches, {.tolerance_mm = 3.0});
  ASSERT_FALSE(motions.empty());
  EXPECT_GT(motions[0].matches, 30U);
  EXPECT_TRUE(is_same_motion(motions[0].to_from, far_motion(), Eigen::Vector3d::Zero(), 40.0, 4.0));
}

TEST(VoxelDownsample, KeepsOnePointForEachCubeAndDirection) {
  SurfacePoints points;
  for (int i = 0; i < 10; ++i) {
    const auto x = 0.1F * static_cast<float>(i);
    points.add({x, 0.2F, 0.2F}, Eigen::Vector3f::UnitZ());
    points.add({x, 0.2F, 0.2F}, -Eigen::Vector3f::UnitZ());  // the other side of a thin wall
  }
  points.add({1.5F, 0.2F, 0.2F}, Eigen::Vector3f::UnitZ());
  EXPECT_EQ(voxel_downsample(points, 1.0).size(), 3U);
}

}  // namespace
}  // namespace frangia
