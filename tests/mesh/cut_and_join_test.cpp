// Cuts, bridges, remeshing and self-intersections of shapes with known areas and volumes.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/bridge_loops.h"
#include "frangia/mesh/cut_by_plane.h"
#include "frangia/mesh/mesh_findings.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remesh_isotropic.h"
#include "frangia/mesh/self_intersections.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::box;
using testing::open_edges;
using testing::sphere;
using testing::volume_mm3;

Mesh fine_ball(double radius = 20.0, const Vector3d& center = Vector3d::Zero()) {
  return sphere(center, radius, 40);
}

Eigen::Hyperplane<double, 3> plane(const Vector3d& normal, double along) {
  return {normal.normalized(), -along};
}

TEST(CutByPlane, LeavesTheVolumeOfASegmentOfASphereWhenCapped) {
  const double height = 8.0;  // of the segment
  const Mesh cut = cut_by_plane(fine_ball(), plane({1, 2, 3}, 20.0 - height), {.capped = true});
  EXPECT_EQ(open_edges(cut), 0U);
  EXPECT_NEAR(volume_mm3(cut) / (kPi * height * height * (20.0 - height / 3.0)), 1.0, 0.01);
}

TEST(CutByPlane, LeavesOneLoopInThePlaneAndSynthesizesNothingWhenOpen) {
  const Mesh cut = cut_by_plane(fine_ball(), plane({0, 0, 1}, 5.3));
  const auto loops = boundary_loops(cut);
  ASSERT_EQ(loops.size(), 1U);
  for (const std::uint32_t v : vertices_of(cut, loops[0]))
    EXPECT_NEAR(cut.vertices_mm[v].z(), 5.3, 1e-5);
  EXPECT_EQ(mesh_findings(cut).marks[2], 0U);
}

TEST(CutByPlane, CapsATubeWithItsHole) {
  Mesh tube = box({0, 0, 0}, {30, 30, 40});
  append_mesh(tube, reverse_orientation(box({10, 10, -5}, {20, 20, 45})));
  const Mesh cut = cut_by_plane(tube, plane({0, 0, -1}, -25.0), {.capped = true});
  const Mesh both = cut_by_plane(cut, plane({0, 0, 1}, 10.0), {.capped = true});
  EXPECT_EQ(open_edges(both), 0U);
  EXPECT_NEAR(volume_mm3(both), (900.0 - 100.0) * 15.0, 0.01);
}

TEST(CutByPlane, MakesNoSliversAtVerticesAndEdgesOnThePlane) {
  const Mesh cut = cut_by_plane(fine_ball(), plane({0, 0, 1}, 0.0), {.capped = true});
  EXPECT_EQ(open_edges(cut), 0U);
  EXPECT_EQ(mesh_findings(cut).degenerate_triangles, 0U);
  EXPECT_TRUE(cut_by_plane(fine_ball(), plane({0, 0, 1}, 30.0)).empty());
  EXPECT_EQ(cut_by_plane(fine_ball(), plane({0, 0, 1}, -30.0)).triangles, fine_ball().triangles);
}

TEST(BridgeLoops, JoinsTwoHalvesToOneClosedComponent) {
  Mesh halves = cut_by_plane(fine_ball(), plane({0, 0, 1}, 4.0));
  append_mesh(halves, cut_by_plane(fine_ball(), plane({0, 0, -1}, 4.0)));
  ASSERT_EQ(boundary_loops(halves).size(), 2U);
  const Mesh whole = bridge_loops(halves, 0, 1);
  EXPECT_EQ(open_edges(whole), 0U);
  EXPECT_EQ(connected_components(whole).components.size(), 1U);
  // The bridge is nearly a cylinder.
  const double ball_mm3 = testing::volume_mm3(fine_ball());
  EXPECT_NEAR(volume_mm3(whole) / ball_mm3, 1.0, 0.03);
  EXPECT_EQ(mesh_findings(whole).marks[2], whole.triangles.size() - halves.triangles.size());
  EXPECT_THROW(static_cast<void>(bridge_loops(halves, 0, 0)), Error);
  EXPECT_THROW(static_cast<void>(bridge_loops(halves, 0, 2)), Error);
}

TEST(RemeshIsotropic, MakesEdgesOfOneLengthOnTheSameSurface) {
  Mesh mesh = fine_ball();
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.05F);
  const Mesh even = remesh_isotropic(mesh, {.edge_mm = 2.0, .iterations = 5});
  EXPECT_EQ(open_edges(even), 0U);
  EXPECT_NEAR(mean_edge_length_mm(even), 2.0, 0.3);
  EXPECT_LT(hausdorff_distance_mm(RayScene(mesh), RayScene(even), 0.5), 0.1);
  EXPECT_EQ(even.sigma_mm.size(), even.vertices_mm.size());
  EXPECT_NEAR(even.sigma_mm[7], 0.05F, 1e-4F);
}

TEST(RemeshIsotropic, KeepsTheEdgesOfABox) {
  const Mesh even = remesh_isotropic(box({0, 0, 0}, {10, 20, 30}), {.edge_mm = 2.0});
  EXPECT_NEAR(volume_mm3(even), 6000.0, 0.1);
  EXPECT_GT(even.triangles.size(), 500U);
}

TEST(SelfIntersections, FindsNoneInASphereABoxOrSeparateBoxes) {
  EXPECT_TRUE(self_intersections(fine_ball()).empty());
  Mesh boxes = box({0, 0, 0}, {1, 1, 1});
  append_mesh(boxes, box({1.001F, 0, 0}, {2, 1, 1}));
  EXPECT_TRUE(self_intersections(boxes).empty());
}

TEST(SelfIntersections, FindsThemOnlyWhereTwoBallsIntersect) {
  Mesh mesh = fine_ball(10.0);
  append_mesh(mesh, fine_ball(10.0, {12.0, 0.3, 0.2}));
  const Selection intersecting = select_self_intersections(mesh);
  EXPECT_GT(count_selected(intersecting), 100U);
  for (std::size_t i = 0; i < intersecting.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Eigen::Vector3f centroid =
        (mesh.vertices_mm[t[0]] + mesh.vertices_mm[t[1]] + mesh.vertices_mm[t[2]]) / 3.0F;
    const bool near = std::abs(centroid.x() - 6.0F) < 1.5F;
    EXPECT_TRUE(near || intersecting[i] == 0) << i;
  }
}

TEST(SelfIntersections, FindsAFoldAndDuplicateTriangles) {
  Mesh fold;
  fold.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2F, 0.7F, 0}};
  fold.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(self_intersections(fold).size(), 1U);
  fold.triangles = {{0, 1, 2}, {2, 0, 1}};
  EXPECT_EQ(self_intersections(fold).size(), 1U);
}

TEST(MeshFindings, DescribeABoxWithAHole) {
  Mesh mesh = box({0, 0, 0}, {10, 20, 30});
  MeshFindings found = mesh_findings(mesh);
  EXPECT_TRUE(found.closed);
  EXPECT_NEAR(found.volume_mm3, 6000.0, 1e-6);
  EXPECT_NEAR(found.area_mm2, 2200.0, 1e-6);
  EXPECT_EQ(found.box_mm.max(), Vector3d(10, 20, 30));
  EXPECT_EQ(found.self_intersections.value_or(99), 0U);
  found = mesh_findings(delete_selected(mesh, select_by_normal(mesh, {0, 0, 1}, 0.1)));
  EXPECT_FALSE(found.closed);
  ASSERT_EQ(found.holes.size(), 1U);
  EXPECT_NEAR(found.holes[0].length_mm, 60.0, 1e-6);
}

TEST(MeshFindings, AreEmptyForAnEmptyMesh) {
  const MeshFindings found = mesh_findings(Mesh());
  EXPECT_FALSE(found.closed);
  EXPECT_EQ(found.triangles, 0U);
}

}  // namespace
}  // namespace frangia
