// Deviations from a reference, their uncertainty, and what is left out.
#include "frangia/inspect/deviation.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/random.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

std::size_t count_of(const Deviations& deviations, DeviationStatus status) {
  return static_cast<std::size_t>(
      std::count(deviations.status.begin(), deviations.status.end(), status));
}

TEST(Deviation, IsTheDistanceFromASphereWithItsSign) {
  const RayScene reference(testing::sphere({0, 0, 0}, 20.0, 200));
  for (const double radius : {19.5, 20.25}) {
    const Mesh mesh = testing::sphere({0, 0, 0}, radius, 60);
    const Deviations found = deviations_of(mesh, reference);
    EXPECT_EQ(count_of(found, DeviationStatus::Compared), mesh.vertices_mm.size());
    for (const float deviation : found.deviation_mm)
      EXPECT_NEAR(deviation, radius - 20.0, 0.003);  // the facets of the reference
  }
}

TEST(Deviation, EqualsTheDistanceFromEveryTriangle) {
  Mesh mesh = testing::sphere({0, 0, 0}, 18.0, 20);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    mesh.vertices_mm[i] *= 1.0F + 0.1F * static_cast<float>(uniform_from(hash(3U, i)));
  const RayScene reference(testing::box({-15, -15, -15}, {15, 15, 15}));
  const Deviations found = deviations_of(mesh, reference);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    if (found.status[i] != DeviationStatus::Compared) continue;
    const Vector3d p = mesh.vertices_mm[i].cast<double>();
    const Vector3d beyond = (p.cwiseAbs() - Vector3d::Constant(15.0)).cwiseMax(0.0);
    const double outside = beyond.norm();
    const double inside = (Vector3d::Constant(15.0) - p.cwiseAbs()).minCoeff();
    EXPECT_NEAR(found.deviation_mm[i], outside > 0.0 ? outside : -inside, 1e-5);
  }
  EXPECT_GT(count_of(found, DeviationStatus::Compared), mesh.vertices_mm.size() / 2);
}

TEST(Deviation, HasTheSameBytesForAnyNumberOfThreads) {
  const Mesh mesh = testing::relief();
  Mesh moved = mesh;
  for (std::size_t i = 0; i < moved.vertices_mm.size(); ++i)
    moved.vertices_mm[i].z() += static_cast<float>(uniform_from(hash(5U, i)));
  moved.sigma_mm.assign(moved.vertices_mm.size(), 0.01F);
  const RayScene reference(mesh);
  const Deviations many = deviations_of(moved, reference);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Deviations single = deviations_of(moved, reference);
  const std::size_t bytes = many.deviation_mm.size() * sizeof(float);
  EXPECT_EQ(std::memcmp(many.deviation_mm.data(), single.deviation_mm.data(), bytes), 0);
  EXPECT_EQ(std::memcmp(many.u_mm.data(), single.u_mm.data(), bytes), 0);
  EXPECT_EQ(many.status, single.status);
}

TEST(Deviation, LeavesOutAndCountsWhatIsNotComparable) {
  Mesh mesh = testing::relief();
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  for (std::size_t t = 2000; t < 2500; ++t)
    mesh.triangle_marks[t] = Mark::Synthesized;
  mesh.vertices_mm.emplace_back(0.0F, 0.0F, 50.0F);  // no triangle uses it
  Mesh larger = testing::relief();
  const Deviations found = deviations_of(mesh, RayScene(larger));
  EXPECT_EQ(count_of(found, DeviationStatus::Unused), 1U);
  EXPECT_GT(count_of(found, DeviationStatus::MeshEdge), 150U);  // of 196 on the boundary
  for (std::size_t i = 0; i + 1 < found.status.size(); ++i) {
    const bool outer = i % 50 == 0 || i % 50 == 49 || i < 50 || i >= 49 * 50;
    EXPECT_FALSE(outer && found.status[i] == DeviationStatus::Compared) << i;
    EXPECT_FALSE(!outer && found.status[i] == DeviationStatus::MeshEdge) << i;
  }
  EXPECT_GT(count_of(found, DeviationStatus::Synthesized), 0U);
  EXPECT_TRUE(std::isnan(found.deviation_mm.back()));

  // A reference that ends before the mesh does.
  Mesh smaller = larger;
  std::erase_if(smaller.triangles, [&](const Mesh::Triangle& triangle) {
    return larger.vertices_mm[triangle[0]].x() > 30.0F;
  });
  const Deviations beyond = deviations_of(larger, RayScene(smaller));
  for (std::size_t i = 0; i < larger.vertices_mm.size(); ++i) {
    if (larger.vertices_mm[i].x() > 33.0F) {
      EXPECT_NE(beyond.status[i], DeviationStatus::Compared) << i;
    }
  }
  EXPECT_GT(count_of(beyond, DeviationStatus::ReferenceEdge), 400U);
  EXPECT_EQ(count_of(deviations_of(larger, RayScene(smaller), {.max_distance_mm = 1.0}),
                     DeviationStatus::OtherSide),
            0U);
  EXPECT_GT(count_of(deviations_of(larger, RayScene(smaller), {.max_distance_mm = 1.0}),
                     DeviationStatus::TooFar),
            400U);
}

TEST(Deviation, CombinesSigmaPoseAndTemperature) {
  Mesh mesh = testing::sphere({0, 0, 0}, 50.1, 40);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.003F);
  DeviationOptions options;
  options.pose = PoseUncertainty{};
  options.pose->covariance(5, 5) = 0.004 * 0.004;  // translation along z
  options.expansion_per_k = 12e-6;
  options.temperature_u_k = 2.0;
  const Deviations found =
      deviations_of(mesh, RayScene(testing::sphere({0, 0, 0}, 50.0, 90)), options);
  const double heat = 50.1 * 12e-6 * 2.0;
  EXPECT_NEAR(found.u_mm.front(), std::hypot(0.003, 0.004, heat), 2e-6);  // the pole
  const auto equator = static_cast<std::size_t>(1 + 19 * 80);
  EXPECT_NEAR(mesh.vertices_mm[equator].z(), 0.0, 1e-3);
  EXPECT_NEAR(found.u_mm[equator], std::hypot(0.003, heat), 2e-6);
  EXPECT_NEAR(found.largest_pose_u_mm, 0.004, 1e-6);
  EXPECT_NEAR(found.largest_temperature_u_mm, heat, 1e-6);
}

TEST(Deviation, IsDecidedByTheRuleOfIso14253) {
  const ToleranceLimits limits{-0.1, 0.1};
  EXPECT_EQ(conformity_of(0.083, 0.01, limits), Conformity::In);
  EXPECT_EQ(conformity_of(0.084, 0.01, limits), Conformity::Undecided);
  EXPECT_EQ(conformity_of(-0.116, 0.01, limits), Conformity::Undecided);
  EXPECT_EQ(conformity_of(-0.117, 0.01, limits), Conformity::Out);
  EXPECT_EQ(conformity_of(0.0, 0.2, limits), Conformity::Undecided);
  EXPECT_EQ(conformity_of(0.0, std::nan(""), limits), Conformity::Undecided);
  EXPECT_NEAR(guard_band_of_many(1), kGuardBand, 1e-9);
  EXPECT_NEAR(guard_band_of_many(1'000'000), 5.3267, 1e-3);  // quantile of 1 - 5e-8
}

TEST(Deviation, IsSummedUpOverTheArea) {
  // One half of the sphere is 0.2 mm too high.
  Mesh mesh = testing::sphere({0, 0, 0}, 20.0, 60);
  for (auto& vertex : mesh.vertices_mm)
    if (vertex.z() > 1e-3F) vertex *= 20.2F / 20.0F;
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.005F);
  const Deviations found = deviations_of(mesh, RayScene(testing::sphere({0, 0, 0}, 20.0, 180)));
  const DeviationSummary summary = summarize(mesh, found);
  EXPECT_NEAR(summary.max_mm, 0.2, 0.005);
  EXPECT_GT(summary.max_at_mm.z(), 0.0);
  EXPECT_NEAR(summary.max_at_mm.norm(), 20.2, 0.005);
  EXPECT_NEAR(summary.median_u_mm, 0.005, 1e-6);
  const auto shares = deviation_histogram(mesh, found.deviation_mm, -0.3, 0.3, 6);
  EXPECT_NEAR(shares[2] + shares[3], 0.5, 0.03);
  EXPECT_NEAR(shares[4] + shares[5], 0.5, 0.03);
}

}  // namespace
}  // namespace frangia
