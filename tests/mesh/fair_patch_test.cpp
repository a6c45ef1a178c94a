// The shape of a faired patch over holes whose surface is known: a sphere, and a plane as the
// minimal surface of a planar boundary.
#include "frangia/mesh/internal/fair_patch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/mesh/internal/refine_patch.h"
#include "frangia/mesh/internal/triangulate_hole.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr double kSphereMm = 20.0;
constexpr std::uint32_t kCorners = 48;
const double kPolarRad = rad_from_deg(40.0);

/// The circle of vertices of a sphere at a polar angle.
std::vector<Vector3d> parallel_of_sphere(double polar_rad) {
  std::vector<Vector3d> circle;
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const double turn = kTwoPi * i / kCorners;
    circle.emplace_back(kSphereMm * Vector3d(std::sin(polar_rad) * std::cos(turn),
                                             std::sin(polar_rad) * std::sin(turn),
                                             std::cos(polar_rad)));
  }
  return circle;
}

/// The ring of triangles of a sphere outside the hole.
PatchSurroundings ring_of_sphere() {
  PatchSurroundings around{.outer_mm = parallel_of_sphere(kPolarRad + rad_from_deg(5.0)),
                           .triangles = {}};
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const std::uint32_t next = (i + 1) % kCorners;
    around.triangles.push_back({i, kCorners + i, kCorners + next});
    around.triangles.push_back({i, kCorners + next, next});
  }
  return around;
}

/// A refined, flat patch over the hole.
PatchMesh flat_patch_over_cap() {
  const std::vector<Vector3d> boundary = parallel_of_sphere(kPolarRad);
  PatchMesh patch(boundary, minimum_area_triangulation(boundary), {});
  patch.restore_delaunay();
  const double edge_mm = (boundary[1] - boundary[0]).norm();
  PatchRefinement refinement(patch, {kCorners, PatchSpacing{.edge_mm = edge_mm}});
  EXPECT_TRUE(refinement.refine_coarsely());
  EXPECT_GT(patch.count(), kCorners + 20);
  return patch;
}

TEST(FairPatch, ContinuesASphere) {
  PatchMesh patch = flat_patch_over_cap();
  ASSERT_TRUE(fair_patch(patch, ring_of_sphere()));
  for (std::uint32_t v = 0; v < patch.count(); ++v)
    EXPECT_NEAR(patch.position(v).norm(), kSphereMm, 0.02 * kSphereMm) << v;
}

TEST(FairPatch, WithoutCurvatureIsThePlaneOfAPlanarBoundary) {
  PatchMesh patch = flat_patch_over_cap();
  const double plane_mm = kSphereMm * std::cos(kPolarRad);
  for (std::uint32_t v = kCorners; v < patch.count(); ++v)  // away from the plane first
    patch.move(v, patch.position(v) + Vector3d(0.0, 0.0, v % 2 == 0 ? 1.0 : 0.5));
  ASSERT_TRUE(fair_patch(patch, ring_of_sphere(), 0.0));
  for (std::uint32_t v = 0; v < patch.count(); ++v)
    EXPECT_NEAR(patch.position(v).z(), plane_mm, 1e-6) << v;
}

TEST(FairPatch, WithHalfOfTheCurvatureLiesHalfWayToTheSphere) {
  const auto height = [](double curvature) {
    PatchMesh patch = flat_patch_over_cap();
    EXPECT_TRUE(fair_patch(patch, ring_of_sphere(), curvature));
    double highest = 0.0;
    for (std::uint32_t v = 0; v < patch.count(); ++v)
      highest = std::max(highest, patch.position(v).z());
    return highest - kSphereMm * std::cos(kPolarRad);
  };
  EXPECT_NEAR(height(0.5) / height(1.0), 0.5, 0.05);
}

TEST(FairPatch, KeepsItsBoundary) {
  PatchMesh patch = flat_patch_over_cap();
  ASSERT_TRUE(fair_patch(patch, ring_of_sphere()));
  const std::vector<Vector3d> boundary = parallel_of_sphere(kPolarRad);
  for (std::uint32_t v = 0; v < kCorners; ++v)
    EXPECT_EQ(patch.position(v), boundary[v]);
}

}  // namespace
}  // namespace frangia
