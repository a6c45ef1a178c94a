#include "frangia/mesh/fill_holes.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "frangia/geometry/boundary.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/self_intersections.h"

#include "ball_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::ball;
using testing::box;
using testing::farthest_from_ball;
using testing::holed_ball;
using testing::kBallRadius;
using testing::noisy;
using testing::open_edges;
using testing::sphere;
using testing::volume_mm3;

TEST(FillHoles, FillsAHoleInASphereWithin150MicrometresOfTheSphere) {
  const Mesh open = holed_ball();
  const Mesh filled = fill_holes(open);
  EXPECT_EQ(open_edges(filled), 0U);
  EXPECT_LT(farthest_from_ball(filled), 0.15);
  EXPECT_NEAR(volume_mm3(filled) / volume_mm3(ball()), 1.0, 0.001);
}

TEST(FillHoles, FillsAHoleOfManyEdgesOnTheSphereWithoutIntersections) {
  const Mesh fine = sphere(Vector3d::Zero(), kBallRadius, 150);
  const Mesh open = delete_selected(fine, select_by_ball(fine, {kBallRadius, 0.0, 0.0}, 14.0));
  ASSERT_GT(boundary_loops(open)[0].edges.size(), 250U);  // more than are searched at once
  const Mesh filled = fill_holes(open);
  EXPECT_EQ(open_edges(filled), 0U);
  EXPECT_LT(farthest_from_ball(filled), 0.15);
  EXPECT_TRUE(self_intersections(filled).empty());
  EXPECT_NEAR(mean_edge_length_mm(filled) / mean_edge_length_mm(open), 1.0, 0.15);
}

TEST(FillHoles, StaysNearTheBoundaryOfANoisyHole) {
  Mesh rough = noisy(sphere(Vector3d::Zero(), kBallRadius, 60), 0.3);
  rough = delete_selected(rough, select_by_ball(rough, {kBallRadius, 0.0, 0.0}, 15.0));
  const Mesh filled = fill_holes(rough);
  EXPECT_EQ(open_edges(filled), 0U);
  for (const auto& vertex : filled.vertices_mm)
    ASSERT_LT(vertex.norm(), 1.3F * static_cast<float>(kBallRadius));
}

TEST(FillHoles, MarksSynthesizedTrianglesAndKeepsMeasuredOnes) {
  const Mesh open = holed_ball();
  for (const HoleFill kind : {HoleFill::Flat, HoleFill::Smooth}) {
    const Mesh filled = fill_holes(open, {.kind = kind});
    EXPECT_EQ(open_edges(filled), 0U);
    for (std::size_t i = 0; i < open.triangles.size(); ++i) {
      ASSERT_EQ(filled.triangles[i], open.triangles[i]);
      ASSERT_EQ(mark_of(filled, i), Mark::Measured);
    }
    for (std::size_t i = open.triangles.size(); i < filled.triangles.size(); ++i)
      ASSERT_EQ(mark_of(filled, i), Mark::Synthesized);
  }
}

TEST(FillHoles, StaysNearABoundaryWithSlivers) {
  Mesh open = holed_ball();
  const auto boundary = vertices_of(open, boundary_loops(open)[0]);
  for (std::size_t i = 0; i + 1 < boundary.size(); i += 2)  // pairs of corners at one place
    open.vertices_mm[boundary[i]] = open.vertices_mm[boundary[i + 1]];
  const Mesh filled = fill_holes(open);
  EXPECT_TRUE(boundary_loops(filled).empty());
  for (const auto& vertex : filled.vertices_mm)
    ASSERT_LT(vertex.norm(), 1.5F * static_cast<float>(kBallRadius));
}

TEST(FillHoles, KeepsHolesAboveTheSize) {
  EXPECT_EQ(boundary_loops(fill_holes(holed_ball(), {.up_to_mm = 10.0})).size(), 1U);
}

TEST(FillHoles, FillsABoxFlatToItsExactVolume) {
  Mesh mesh = box({0, 0, 0}, {10, 20, 30});
  mesh = delete_selected(mesh, select_by_normal(mesh, {0, 0, 1}, 0.1));
  EXPECT_NEAR(volume_mm3(fill_holes(mesh, {.kind = HoleFill::Flat})), 6000.0, 1e-3);
}

}  // namespace
}  // namespace frangia
