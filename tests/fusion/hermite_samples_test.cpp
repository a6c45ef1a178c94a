#include <cmath>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {
namespace {

TEST(MakeHermiteSamples, PutsThePointOntoTheObservedSurface) {
  EdgeCrossings crossings;
  crossings.points_mm = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
  HermiteAccumulators hermite(2);
  HermiteAccumulator::PlaneSum& face = hermite[0].first;
  face.weight = 4.0F;  // two views of weight 2, which observe the surface 0.1 mm behind
  face.weight_squared = 8.0F;
  face.offset = 0.4F;
  face.noise_squared = 4.0F * 2.0F * 0.01F;
  face.spacing = 0.8F;
  face.normal = 4.0F * Eigen::Vector3f::UnitZ();
  face.views = 2;
  const HermiteSamples samples = make_hermite_samples(crossings, hermite);
  ASSERT_EQ(samples.size(), 2U);
  ASSERT_TRUE(samples[0].supported);
  EXPECT_FALSE(samples[0].has_lesser);
  EXPECT_NEAR((samples[0].point - Eigen::Vector3f(1.0F, 2.0F, 2.9F)).norm(), 0.0F, 1e-6F);
  EXPECT_EQ(samples[0].normal, Eigen::Vector3f::UnitZ());
  EXPECT_NEAR(samples[0].noise_mm, 0.1 / std::sqrt(2.0), 1e-6);  // 0.1 mm each
  EXPECT_NEAR(samples[0].spacing_mm, 0.2F, 1e-6F);
  EXPECT_EQ(samples[0].views, 2);
  EXPECT_FALSE(samples[1].supported) << "no view observed it";
}

TEST(MakeHermiteSamples, KeepsTheLesserPlaneNearAnEdge) {
  EdgeCrossings crossings;
  crossings.points_mm = {Eigen::Vector3f::Zero()};
  HermiteAccumulators hermite(1);
  for (int i = 0; i < 2; ++i) {
    HermiteAccumulator::PlaneSum& face = i == 0 ? hermite[0].first : hermite.make_secondary(0);
    face.weight = 2.0F - static_cast<float>(i);
    face.offset = 0.1F * face.weight;
    face.normal = face.weight * Eigen::Vector3f::Unit(i);
    face.views = 1;
  }
  const HermiteSamples samples = make_hermite_samples(crossings, hermite);
  ASSERT_TRUE(samples[0].has_lesser);
  EXPECT_EQ(samples[0].normal, Eigen::Vector3f::UnitX());
  const HermiteSample side = lesser_sample(crossings, hermite, 0);
  EXPECT_EQ(side.normal, Eigen::Vector3f::UnitY());
  EXPECT_NEAR((side.point - Eigen::Vector3f(0.0F, -0.1F, 0.0F)).norm(), 0.0F, 1e-6F);
}

}  // namespace
}  // namespace frangia
