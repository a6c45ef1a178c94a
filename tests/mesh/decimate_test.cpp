#include "frangia/mesh/decimate.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "frangia/geometry/boundary.h"
#include "frangia/geometry/hausdorff_distance.h"

#include "ball_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::ball;
using testing::box;
using testing::even_ball;
using testing::farthest_from_ball;
using testing::finer;
using testing::holed_ball;
using testing::kBallRadius;
using testing::noisy;
using testing::open_edges;
using testing::sphere;
using testing::volume_mm3;

TEST(Decimate, KeepsASphereClosedOrientedAndNear) {
  const Mesh mesh = sphere(Vector3d::Zero(), kBallRadius, 80);
  const Mesh few = decimate(mesh, {.triangles = mesh.triangles.size() / 10});
  EXPECT_LE(few.triangles.size(), mesh.triangles.size() / 10);
  EXPECT_EQ(open_edges(few), 0U);
  EXPECT_NEAR(volume_mm3(few) / volume_mm3(mesh), 1.0, 0.003);
  EXPECT_LT(farthest_from_ball(few), 0.1);
}

TEST(Decimate, KeepsABoxOfManyTriangles) {
  Mesh mesh = box({0, 0, 0}, {10, 20, 30});
  for (int round = 0; round < 3; ++round)
    mesh = finer(mesh);
  ASSERT_EQ(open_edges(mesh), 0U);
  const Mesh few = decimate(mesh, {.triangles = 0, .tolerance_mm = 1e-3});
  EXPECT_LT(few.triangles.size(), 40U);
  EXPECT_NEAR(volume_mm3(few), 6000.0, 1.0);
}

TEST(Decimate, StaysWithinItsToleranceOfANoisySurfaceInBothDirections) {
  const RayScene rough(noisy(even_ball(), 0.02));
  const double spacing = mean_edge_length_mm(rough.mesh()) / 3.0;
  std::size_t last = rough.mesh().triangles.size();
  for (const double tolerance_mm : {0.02, 0.05, 0.1}) {
    const RayScene few(decimate(rough.mesh(), {.tolerance_mm = tolerance_mm}));
    EXPECT_LE(hausdorff_distance_mm(rough, few, spacing), tolerance_mm);
    EXPECT_LT(few.mesh().triangles.size(), last);
    EXPECT_EQ(open_edges(few.mesh()), 0U);
    last = few.mesh().triangles.size();
  }
  EXPECT_LT(last, rough.mesh().triangles.size() / 5);
}

TEST(Decimate, KeepsAHoleWithinATolerance) {
  const Mesh open = holed_ball();
  const Mesh few = decimate(open, {.tolerance_mm = 0.1});
  EXPECT_LT(few.triangles.size(), open.triangles.size() / 3);
  EXPECT_LT(hausdorff_distance_mm(RayScene(open), RayScene(few), 0.5), 0.1001);
  EXPECT_EQ(boundary_loops(few).size(), 1U);
}

TEST(Decimate, KeepsTheBoundaryOfAHoleInPlace) {
  const Mesh few = decimate(holed_ball(), {.triangles = 1000});
  ASSERT_EQ(boundary_loops(few).size(), 1U);
  EXPECT_NEAR(boundary_loops(few)[0].size_mm, boundary_loops(holed_ball())[0].size_mm, 0.5);
}

}  // namespace
}  // namespace frangia
