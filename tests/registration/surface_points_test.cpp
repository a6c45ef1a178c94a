#include "frangia/registration/surface_points.h"

#include <cmath>

#include <gtest/gtest.h>

namespace frangia {
namespace {

using Eigen::Vector3f;

TEST(VoxelDownsample, KeepsThePointNearestToTheMeanOfItsCube) {
  SurfacePoints points;
  points.add({0.1F, 0.1F, 0.1F}, Vector3f::UnitZ());
  points.add({0.6F, 0.5F, 0.5F}, Vector3f(0.6F, 0.0F, 0.8F));
  points.add({1.9F, 1.8F, 1.9F}, Vector3f::UnitZ());
  points.add({-0.1F, 0.1F, 0.1F}, Vector3f::UnitZ());  // beyond the origin, another cube
  points.add({2.1F, 0.1F, 0.1F}, Vector3f::UnitZ());
  SurfacePoints reversed;
  for (std::size_t i = points.size(); i-- > 0;)
    reversed.add(points.points_mm[i], points.normals[i]);
  for (const SurfacePoints* given : {&points, &reversed}) {
    const SurfacePoints thin = voxel_downsample(*given, 2.0);
    ASSERT_EQ(thin.size(), 3U);
    EXPECT_EQ(thin.points_mm[0], Vector3f(-0.1F, 0.1F, 0.1F));
    EXPECT_EQ(thin.points_mm[1], Vector3f(0.6F, 0.5F, 0.5F));
    EXPECT_EQ(thin.points_mm[2], Vector3f(2.1F, 0.1F, 0.1F));
    EXPECT_LT((thin.normals[1] - Vector3f(0.6F, 0.0F, 2.8F).normalized()).norm(), 1e-6F);
  }
}

TEST(VoxelDownsample, KeepsTheSixSidesApart) {
  SurfacePoints points;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0F, -1.0F}) {
      points.add(Vector3f::Constant(0.5F), sign * Vector3f::Unit(axis));
      points.add(
          Vector3f::Constant(0.6F),
          (sign * (Vector3f::Unit(axis) + 0.5F * Vector3f::Unit((axis + 1) % 3))).normalized());
    }
  }
  EXPECT_EQ(voxel_downsample(points, 1.0).size(), 6U);
}

TEST(SurfacePoints, AddsAnotherSetMoved) {
  SurfacePoints points;
  points.add({1.0F, 2.0F, 3.0F}, Vector3f::UnitX());
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  move.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  move.translation() = Eigen::Vector3d(10.0, 0.0, 0.0);
  SurfacePoints both = points;
  both.add(points, move);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_LT((both.points_mm[1] - Vector3f(8.0F, 1.0F, 3.0F)).norm(), 1e-5F);
  EXPECT_LT((both.normals[1] - Vector3f::UnitY()).norm(), 1e-6F);
}

}  // namespace
}  // namespace frangia
