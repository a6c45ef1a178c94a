#include "frangia/fusion/view_weights.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/fusion/fuse_views.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::small_camera_model;

Eigen::VectorXf shares_of(const ViewWeights& weights,
                          const Eigen::Vector3f& point,
                          const Eigen::Vector3f& normal) {
  Eigen::VectorXf shares(3);
  weights.shares_at(point, normal, shares);
  return shares;
}

TEST(ViewWeights, AreThoseOfThePlacesAroundThatFaceTheSameWay) {
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  const std::vector<ViewWeights::Place> places{
      {{0.1F, 0.0F, 0.0F}, up, 0}, {{0.1F, 0.0F, -0.2F}, -up, 2}, {{5.0F, 0.0F, 0.0F}, up, 3}};
  const ViewWeights weights(1.0, places, {{0, 3.0F}, {1, 1.0F}, {2, 7.0F}, {1, 4.0F}});
  EXPECT_TRUE(
      shares_of(weights, {0.0F, 0.0F, 0.0F}, up).isApprox(Eigen::Vector3f(0.75F, 0.25F, 0.0F)));
  EXPECT_TRUE(
      shares_of(weights, {0.0F, 0.0F, 0.0F}, -up).isApprox(Eigen::Vector3f(0.0F, 0.0F, 1.0F)));
  EXPECT_TRUE(
      shares_of(weights, {5.9F, 0.9F, 0.0F}, up).isApprox(Eigen::Vector3f(0.0F, 1.0F, 0.0F)));
  EXPECT_EQ(shares_of(weights, {2.5F, 0.0F, 0.0F}, up).sum(), 0.0F);
}

/// A sphere seen from two sides: each view has all weight on its own, and a part of it where both
/// see the surface at the same angle.
TEST(ViewWeights, OfASphereAreThoseOfTheViewsThatSeeIt) {
  const std::vector<Eigen::Isometry3d> poses{testing::look_from(0.0, 0.0, 650.0),
                                             testing::look_from(rad_from_deg(90.0), 0.0, 650.0)};
  const CameraModel camera = small_camera_model(160);
  const ViewStore views = testing::snapshots(testing::sphere(50.0), camera, poses);
  const std::vector<CameraViews> cameras{{views, camera}};
  const FusedSurface fused = fuse_with_weights(cameras, {.voxel_mm = 2.0});
  ASSERT_FALSE(fused.mesh.empty());
  std::vector<Eigen::Vector3f> towards;
  for (const auto& pose : poses)
    towards.push_back(pose.inverse().translation().normalized().cast<float>());
  Eigen::VectorXf shares(2);
  float first = 0.0F;
  float both = 0.0F;
  for (std::size_t i = 0; i < fused.mesh.vertices_mm.size(); ++i) {
    const Eigen::Vector3f& point = fused.mesh.vertices_mm[i];
    const Eigen::Vector3f out = point.normalized();
    fused.weights.shares_at(point, out, shares);
    EXPECT_NEAR(shares.sum(), 1.0F, 1e-5F);
    if (out.dot(towards[1]) < -0.1F) {
      EXPECT_EQ(shares[1], 0.0F);
    }
    if (std::abs(out.dot(towards[0] - towards[1])) < 0.1F && std::abs(out.z()) < 0.5F) {
      first += shares[0];
      both += 1.0F;
    }
  }
  EXPECT_GT(both, 20.0F);
  // The noise that each view shows at this slope differs.
  EXPECT_GT(first / both, 0.1F);
  EXPECT_LT(first / both, 0.9F);
}

}  // namespace
}  // namespace frangia
