// Operations on shapes with known areas, volumes and curvature.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/editor/internal/select_by_vertex_data.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/mesh_findings.h"
#include "frangia/mesh/offset_mesh.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/stitch.h"

#include "ball_meshes.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::ball;
using testing::box;
using testing::finer;
using testing::kBallRadius;
using testing::open_edges;
using testing::sphere;
using testing::volume_mm3;

TEST(HalfEdges, TwinsHaveOppositeDirectionsAndAClosedMeshHasNoBoundary) {
  const Mesh mesh = ball();
  const HalfEdges edges(mesh);
  for (std::uint32_t e = 0; e < edges.count(); ++e) {
    ASSERT_TRUE(edges.has_twin(e));
    EXPECT_EQ(edges.twin(edges.twin(e)), e);
    EXPECT_EQ(source_vertex(mesh, edges.twin(e)), target_vertex(mesh, e));
  }
}

TEST(BoundaryLoops, FindTheBoundaryOfAHoleAndItsSize) {
  // Without its cap the ball ends at the ring of vertices at a polar angle of 45 degrees.
  const double height = kBallRadius * std::cos(0.25 * kPi) - 0.01;
  const Mesh cut = delete_selected(ball(), select_by_plane(ball(), {Vector3d::UnitZ(), -height}));
  const auto loops = boundary_loops(cut);
  ASSERT_EQ(loops.size(), 1U);
  const double ring = kBallRadius * std::sin(0.25 * kPi);
  EXPECT_EQ(loops[0].edges.size(), 80U);
  EXPECT_NEAR(loops[0].size_mm, 2.0 * ring, 1e-3);
  EXPECT_NEAR(loops[0].length_mm, 80 * 2.0 * ring * std::sin(kPi / 80), 1e-3);
  EXPECT_TRUE(boundary_loops(ball()).empty());
}

TEST(RemoveIslands, RemovesBySizeAndKeepsTheLargest) {
  Mesh mesh = ball();
  append_mesh(mesh, sphere({50, 0, 0}, 1.0, 6));
  append_mesh(mesh, sphere({60, 0, 0}, 4.0, 6));
  EXPECT_EQ(connected_components(mesh).components.size(), 3U);
  EXPECT_EQ(connected_components(remove_islands(mesh, 5.0)).components.size(), 2U);
  EXPECT_EQ(connected_components(remove_islands(mesh, 1e9)).components.size(), 1U);
  EXPECT_EQ(keep_largest_components(mesh).triangles, ball().triangles);
}

TEST(HausdorffDistance, OfTwoConcentricBallsIsTheDifferenceOfTheirRadii) {
  const RayScene inner(ball());
  const RayScene outer(sphere(Vector3d::Zero(), kBallRadius + 0.5, 40));
  EXPECT_NEAR(hausdorff_distance_mm(inner, outer, 1.0), 0.5, 0.005);
}

TEST(Stitch, ClosesABallOfUnconnectedTriangles) {
  const Mesh whole = ball();
  Mesh loose;
  for (const auto& triangle : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.vertices_mm.size());
    for (const std::uint32_t vertex : triangle)
      loose.vertices_mm.push_back(whole.vertices_mm[vertex]);
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  const Mesh joined = stitch(loose);
  EXPECT_EQ(open_edges(joined), 0U);
  EXPECT_EQ(joined.vertices_mm.size(), whole.vertices_mm.size());
}

TEST(MakeManifold, SplitsTwoBoxesAtASharedEdgeAndRemovesDuplicates) {
  Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  append_mesh(mesh, box({1, 1, 0}, {2, 2, 1}));
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle)  // the second box's edge is the first one's
      vertex = vertex == 8 ? 3 : vertex == 12 ? 7 : vertex;
  }
  mesh.triangles.push_back(mesh.triangles[5]);
  EXPECT_GT(count_non_manifold_edges(mesh), 0U);
  const Mesh split = make_manifold(mesh);
  EXPECT_EQ(count_non_manifold_edges(split), 0U);
  EXPECT_EQ(open_edges(split), 0U);
  EXPECT_NEAR(volume_mm3(split), 2.0, 1e-6);
}

/// Two boxes of 30 mm that share an edge, with `rounds` subdivisions.
Mesh boxes_at_an_edge(int rounds) {
  Mesh mesh = box({0, 0, 0}, {30, 30, 30});
  Mesh other = box({30, 30, 0}, {60, 60, 30});
  for (int round = 0; round < rounds; ++round) {
    mesh = finer(mesh);
    other = finer(other);
  }
  append_mesh(mesh, other);
  // Vertices at one place become one: those of the edge.
  std::map<std::array<float, 3>, std::uint32_t> at;
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      const Eigen::Vector3f& p = mesh.vertices_mm[vertex];
      vertex = at.emplace(std::array{p.x(), p.y(), p.z()}, vertex).first->second;
    }
  }
  return mesh;
}

class Warnings {
 public:
  [[nodiscard]] frangia::Run run() {
    frangia::Run run;
    run.on_warning = [this](const std::string& text) { text_ += text + "\n"; };
    return run;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

TEST(NonManifoldEdges, AreSplitBeforeADecimation) {
  const Mesh mesh = boxes_at_an_edge(4);
  ASSERT_EQ(count_non_manifold_edges(mesh), 16U);
  Warnings warnings;
  const Mesh few = decimate(mesh, {.triangles = 24}, warnings.run());
  EXPECT_LE(few.triangles.size(), 24U);
  EXPECT_EQ(count_non_manifold_edges(few), 0U);
  EXPECT_NEAR(volume_mm3(few), 54'000.0, 1.0);
  EXPECT_NE(warnings.text().find("16 non-manifold edges"), std::string::npos) << warnings.text();
}

TEST(NonManifoldEdges, HideNoHole) {
  Mesh mesh = boxes_at_an_edge(2);
  std::erase_if(mesh.triangles, [&](const Mesh::Triangle& t) {  // open at the top
    return std::all_of(
        t.begin(), t.end(), [&](std::uint32_t v) { return mesh.vertices_mm[v].z() == 30.0F; });
  });
  EXPECT_TRUE(std::isnan(mesh_findings(mesh).volume_mm3));
  Warnings warnings;
  const Mesh filled = fill_holes(mesh, {.kind = HoleFill::Flat}, warnings.run());
  EXPECT_EQ(open_edges(filled), 0U);
  EXPECT_NEAR(volume_mm3(filled), 54'000.0, 1.0);
  EXPECT_NE(warnings.text().find("hole filling split them first"), std::string::npos);
}

TEST(NonManifoldEdges, LeaveTheVolumeOfClosedBodies) {
  const MeshFindings found = mesh_findings(boxes_at_an_edge(0));
  EXPECT_EQ(found.non_manifold_edges, 1U);
  EXPECT_FALSE(found.closed);
  EXPECT_NEAR(found.volume_mm3, 54'000.0, 1e-6);
}

TEST(NonManifoldEdges, OfOppositeOrientationAreRefused) {
  Mesh mesh = box({0, 0, 0}, {10, 20, 30});
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_TRUE(std::isnan(mesh_findings(mesh).volume_mm3));
  EXPECT_NE(testing::error_of([&] { (void)decimate(mesh, {.triangles = 6}); }).find("`orient`"),
            std::string::npos);
  EXPECT_NE(testing::error_of([&] { (void)fill_holes(mesh); }).find("3 edges join two"),
            std::string::npos);
  EXPECT_NEAR(mesh_findings(orient(mesh)).volume_mm3, 6000.0, 1e-6);
}

TEST(Orient, MakesABallConsistentAndOutward) {
  Mesh mesh = reverse_orientation(ball());
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const Mesh turned = orient(mesh);
  EXPECT_EQ(open_edges(turned), 0U);
  EXPECT_NEAR(volume_mm3(turned), volume_mm3(ball()), 1e-3);
}

TEST(Orient, IsFastWhereTensOfThousandsOfTrianglesShareAnEdge) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(30'000, {0, 1, 2});
  // A minute when each visits all others.
  EXPECT_EQ(orient(mesh).triangles, mesh.triangles);
  EXPECT_EQ(count_non_manifold_edges(mesh), 3U);
}

TEST(OffsetMesh, OffsetsTheFacesOfABoxToALargerBox) {
  EXPECT_NEAR(volume_mm3(offset_mesh(box({0, 0, 0}, {10, 20, 30}), 1.0)), 12.0 * 22.0 * 32.0, 0.01);
}

TEST(MirrorMesh, KeepsTheVolumeAndFacesOutwards) {
  const Mesh mirrored = mirror_mesh(box({0, 0, 0}, {1, 2, 3}), {Vector3d::UnitX(), 0.0});
  EXPECT_NEAR(volume_mm3(mirrored), 6.0, 1e-6);
  EXPECT_EQ(mirrored.vertices_mm[1].x(), -1.0F);
}

TEST(AlignFaces, MovesARotatedBoxToTheOrigin) {
  const Mesh square = box({0, 0, 0}, {10, 20, 30});
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translate(Vector3d(5, -7, 11));
  turn.rotate(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  const Mesh mesh = transform_mesh(square, turn);
  const auto face = [&](const Vector3d& picked) {
    return fit_plane(mesh, select_face(mesh, turn * picked));
  };
  const Mesh back =
      transform_mesh(mesh, align_faces(face({5, 10, 0}), face({0, 10, 15}), face({5, 0, 15})));
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_LT((back.vertices_mm[i] - square.vertices_mm[i]).norm(), 1e-4F);
}

TEST(SelectFace, IsThatOfThePickedTriangleAlsoWhereTheCenterOfAnotherIsNearer) {
  // A wall 100 mm high of one strip, at the edge of a floor of small triangles.
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {1, 0, 100}, {0, 0, 100}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 5}};
  EXPECT_EQ(select_face(mesh, {0.5, 0.0, 2.0}), (Selection{1, 1, 0, 0}));
  EXPECT_EQ(select_face(mesh, {0.5, 0.5, 0.0}), (Selection{0, 0, 1, 1}));
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  const Mesh mesh = ball();
  const auto curvature = mean_curvature_per_mm(mesh);
  for (std::size_t i = 400; i < 2800; ++i)
    ASSERT_NEAR(curvature[i], 1.0 / kBallRadius, 0.003);
}

TEST(Selection, GrowsShrinksAndInverts) {
  const Mesh mesh = ball();
  const Selection cap = select_by_ball(mesh, {kBallRadius, 0, 0}, 8.0);
  const Selection larger = grow_selection(mesh, cap);
  EXPECT_GT(count_selected(larger), count_selected(cap));
  const Selection shrunk = shrink_selection(mesh, larger);
  EXPECT_LT(count_selected(shrunk), count_selected(larger));
  for (std::size_t i = 0; i < cap.size(); ++i)
    ASSERT_GE(shrunk[i], cap[i]);
  EXPECT_EQ(count_selected(invert_selection(cap)), mesh.triangles.size() - count_selected(cap));
}

}  // namespace
}  // namespace frangia
