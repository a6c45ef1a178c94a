// Truths of the mesh's edits, on shapes whose every figure is known.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/editor/internal/select_by_vertex_data.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/change_selection.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/offset_mesh.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/self_intersections.h"
#include "frangia/mesh/smooth.h"
#include "frangia/mesh/stitch.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::box;
using testing::open_edges;
using testing::sphere;
using testing::volume_mm3;

constexpr double kRadius = 20.0;

Mesh ball() {
  return sphere(Vector3d::Zero(), kRadius, 40);
}

/// The ball with a hole of 20 mm about its pole, off the poles of its own meridians.
Mesh holed_ball() {
  const Mesh mesh = ball();
  return delete_selected(mesh, select_by_ball(mesh, {kRadius, 0.0, 0.0}, 10.0));
}

/// Each triangle cut into four.
Mesh finer(const Mesh& mesh) {
  Mesh cut = mesh;
  cut.triangles.clear();
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = add_interpolated_vertex(cut, a, b, 0.5F);
    const std::uint32_t bc = add_interpolated_vertex(cut, b, c, 0.5F);
    const std::uint32_t ca = add_interpolated_vertex(cut, c, a, 0.5F);
    for (const auto& t : {Mesh::Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      cut.triangles.push_back(t);
  }
  // Midpoints were made once for each triangle: join them.
  return stitch(cut, 1e-5);
}

/// A ball of triangles alike in size, as a scan has them.
Mesh even_ball() {
  Mesh mesh;
  for (const float s : {1.0F, -1.0F}) {
    for (int axis = 0; axis < 3; ++axis)
      mesh.vertices_mm.emplace_back(s * Eigen::Vector3f::Unit(axis));
  }
  mesh.triangles = {
      {0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  for (int round = 0; round < 5; ++round) {
    mesh = finer(mesh);
    for (auto& vertex : mesh.vertices_mm)
      vertex.normalize();
  }
  for (auto& vertex : mesh.vertices_mm)
    vertex *= static_cast<float>(kRadius);
  return mesh;
}

double farthest_from_ball(const Mesh& mesh) {
  double farthest = 0.0;
  for (const auto& vertex : mesh.vertices_mm)
    farthest = std::max(farthest, std::abs(vertex.cast<double>().norm() - kRadius));
  return farthest;
}

double rms_from_ball(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& vertex : mesh.vertices_mm)
    sum += std::pow(vertex.cast<double>().norm() - kRadius, 2);
  return std::sqrt(sum / static_cast<double>(mesh.vertices_mm.size()));
}

Mesh noisy(Mesh mesh, double sigma_mm) {
  mesh.normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    mesh.vertices_mm[i] += mesh.normals[i] * static_cast<float>(sigma_mm * normal_from(hash(i)));
  mesh.normals.clear();
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), static_cast<float>(sigma_mm));
  return mesh;
}

TEST(HalfEdges, TwinsRunTheOtherWayAndAClosedMeshHasNoBoundary) {
  const Mesh mesh = ball();
  const HalfEdges edges(mesh);
  for (std::uint32_t e = 0; e < edges.count(); ++e) {
    ASSERT_TRUE(edges.has_twin(e));
    EXPECT_EQ(edges.twin(edges.twin(e)), e);
    EXPECT_EQ(source_vertex(mesh, edges.twin(e)), target_vertex(mesh, e));
  }
}

TEST(BoundaryLoops, FindTheBoundaryOfAHoleWithItsSize) {
  // Without its cap the ball ends in its ring at a quarter of the way from pole to pole.
  const double height = kRadius * std::cos(0.25 * kPi) - 0.01;
  const Mesh cut = delete_selected(ball(), select_by_plane(ball(), {Vector3d::UnitZ(), -height}));
  const auto loops = boundary_loops(cut);
  ASSERT_EQ(loops.size(), 1U);
  const double ring = kRadius * std::sin(0.25 * kPi);
  EXPECT_EQ(loops[0].edges.size(), 80U);
  EXPECT_NEAR(loops[0].size_mm, 2.0 * ring, 1e-3);
  EXPECT_NEAR(loops[0].length_mm, 80 * 2.0 * ring * std::sin(kPi / 80), 1e-3);
  EXPECT_TRUE(boundary_loops(ball()).empty());
}

TEST(FillHoles, ClosesAHoleInASphereAsTheSphereRunsWithin150Micrometres) {
  const Mesh open = holed_ball();
  const Mesh filled = fill_holes(open);
  EXPECT_EQ(open_edges(filled), 0U);
  EXPECT_LT(farthest_from_ball(filled), 0.15);
  EXPECT_NEAR(volume_mm3(filled) / volume_mm3(ball()), 1.0, 0.001);
}

TEST(FillHoles, OfManyEdgesAreClosedOnTheSphereAndCrossNothing) {
  const Mesh fine = sphere(Vector3d::Zero(), kRadius, 150);
  const Mesh open = delete_selected(fine, select_by_ball(fine, {kRadius, 0.0, 0.0}, 14.0));
  ASSERT_GT(boundary_loops(open)[0].edges.size(), 250U);  // more than are searched at once
  const Mesh filled = fill_holes(open);
  EXPECT_EQ(open_edges(filled), 0U);
  EXPECT_LT(farthest_from_ball(filled), 0.15);
  EXPECT_TRUE(self_intersections(filled).empty());
  EXPECT_NEAR(mean_edge_length_mm(filled) / mean_edge_length_mm(open), 1.0, 0.15);
}

TEST(FillHoles, OfASheetOfNoiseStayWithinItsReach) {
  Mesh rough = noisy(sphere(Vector3d::Zero(), kRadius, 60), 0.3);
  rough = delete_selected(rough, select_by_ball(rough, {kRadius, 0.0, 0.0}, 15.0));
  const Mesh filled = fill_holes(rough);
  EXPECT_EQ(open_edges(filled), 0U);
  for (const auto& vertex : filled.vertices_mm)
    ASSERT_LT(vertex.norm(), 1.3F * static_cast<float>(kRadius));
}

TEST(FillHoles, MarksWhatItSynthesizesAndLeavesTheMeasuredAsItWas) {
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

TEST(FillHoles, ClosesAHoleWithSliversAtItsBoundaryWithinItsReach) {
  Mesh open = holed_ball();
  const auto rim = vertices_of(open, boundary_loops(open)[0]);
  for (std::size_t i = 0; i + 1 < rim.size(); i += 2)  // pairs of corners at one place
    open.vertices_mm[rim[i]] = open.vertices_mm[rim[i + 1]];
  const Mesh filled = fill_holes(open);
  EXPECT_TRUE(boundary_loops(filled).empty());
  for (const auto& vertex : filled.vertices_mm)
    ASSERT_LT(vertex.norm(), 1.5F * static_cast<float>(kRadius));
}

TEST(FillHoles, LeavesHolesAboveTheSize) {
  EXPECT_EQ(boundary_loops(fill_holes(holed_ball(), {.up_to_mm = 10.0})).size(), 1U);
}

TEST(FillHoles, ClosesABoxFlatToItsExactVolume) {
  Mesh mesh = box({0, 0, 0}, {10, 20, 30});
  mesh = delete_selected(mesh, select_by_normal(mesh, {0, 0, 1}, 0.1));
  EXPECT_NEAR(volume_mm3(fill_holes(mesh, {.kind = HoleFill::Flat})), 6000.0, 1e-3);
}

TEST(Islands, GoBySizeAndTheLargestStays) {
  Mesh mesh = ball();
  append_mesh(mesh, sphere({50, 0, 0}, 1.0, 6));
  append_mesh(mesh, sphere({60, 0, 0}, 4.0, 6));
  EXPECT_EQ(connected_components(mesh).components.size(), 3U);
  EXPECT_EQ(connected_components(remove_islands(mesh, 5.0)).components.size(), 2U);
  EXPECT_EQ(connected_components(remove_islands(mesh, 1e9)).components.size(), 1U);
  EXPECT_EQ(keep_largest_components(mesh).triangles, ball().triangles);
}

TEST(Decimate, KeepsASphereClosedOutwardAndNear) {
  const Mesh mesh = sphere(Vector3d::Zero(), kRadius, 80);
  const Mesh few = decimate(mesh, {.triangles = mesh.triangles.size() / 10});
  EXPECT_LE(few.triangles.size(), mesh.triangles.size() / 10);
  EXPECT_EQ(open_edges(few), 0U);
  EXPECT_NEAR(volume_mm3(few) / volume_mm3(mesh), 1.0, 0.003);
  EXPECT_LT(farthest_from_ball(few), 0.1);
}

TEST(Decimate, KeepsTheBoxItIsWhateverItsTriangles) {
  Mesh mesh = box({0, 0, 0}, {10, 20, 30});
  for (int round = 0; round < 3; ++round)
    mesh = finer(mesh);
  ASSERT_EQ(open_edges(mesh), 0U);
  const Mesh few = decimate(mesh, {.triangles = 0, .tolerance_mm = 1e-3});
  EXPECT_LT(few.triangles.size(), 40U);
  EXPECT_NEAR(volume_mm3(few), 6000.0, 1.0);
}

TEST(Decimate, StaysWithinItsToleranceBothWaysOfARoughSurface) {
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

TEST(Decimate, WithinAToleranceClosesNoHole) {
  const Mesh open = holed_ball();
  const Mesh few = decimate(open, {.tolerance_mm = 0.1});
  EXPECT_LT(few.triangles.size(), open.triangles.size() / 3);
  EXPECT_LT(hausdorff_distance_mm(RayScene(open), RayScene(few), 0.5), 0.1001);
  EXPECT_EQ(boundary_loops(few).size(), 1U);
}

TEST(HausdorffDistance, BetweenTwoBallsIsTheDifferenceOfTheirRadii) {
  const RayScene inner(ball());
  const RayScene outer(sphere(Vector3d::Zero(), kRadius + 0.5, 40));
  EXPECT_NEAR(hausdorff_distance_mm(inner, outer, 1.0), 0.5, 0.005);
}

TEST(Decimate, LeavesTheBoundaryOfAHoleInPlace) {
  const Mesh few = decimate(holed_ball(), {.triangles = 1000});
  ASSERT_EQ(boundary_loops(few).size(), 1U);
  EXPECT_NEAR(boundary_loops(few)[0].size_mm, boundary_loops(holed_ball())[0].size_mm, 0.5);
}

TEST(Smooth, HalvesTheNoiseOfASphereAndMovesNothingBeyondItsSigmas) {
  const Mesh mesh = noisy(even_ball(), 0.05);
  for (const Mesh& smooth : {smooth_taubin(mesh), smooth_keeping_edges(mesh)}) {
    EXPECT_LT(rms_from_ball(smooth), 0.5 * rms_from_ball(mesh));
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
      ASSERT_LE((smooth.vertices_mm[i] - mesh.vertices_mm[i]).norm(), 0.1501F);
  }
}

TEST(Smooth, MarksWhatIsDisplacedBeyondItsSigmaAndNothingElse) {
  const Mesh mesh = noisy(even_ball(), 0.05);
  const Mesh smooth = smooth_taubin(mesh);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const bool moved = (smooth.vertices_mm[i] - mesh.vertices_mm[i]).norm() > 0.05F;
    ASSERT_EQ(smooth.vertex_marks[i] == Mark::Displaced, moved);
  }
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

TEST(MakeManifold, PartsTwoBoxesThatShareAnEdgeAndDropsRepeatedTriangles) {
  Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  append_mesh(mesh, box({1, 1, 0}, {2, 2, 1}));
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle)  // the second box's edge is the first one's
      vertex = vertex == 8 ? 3 : vertex == 12 ? 7 : vertex;
  }
  mesh.triangles.push_back(mesh.triangles[5]);
  EXPECT_GT(count_non_manifold_edges(mesh), 0U);
  const Mesh parted = make_manifold(mesh);
  EXPECT_EQ(count_non_manifold_edges(parted), 0U);
  EXPECT_EQ(open_edges(parted), 0U);
  EXPECT_NEAR(volume_mm3(parted), 2.0, 1e-6);
}

TEST(Orient, TurnsWhatRunsAgainstTheRestAndClosedPartsOutwards) {
  Mesh mesh = reverse_orientation(ball());
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const Mesh turned = orient(mesh);
  EXPECT_EQ(open_edges(turned), 0U);
  EXPECT_NEAR(volume_mm3(turned), volume_mm3(ball()), 1e-3);
}

TEST(OffsetMesh, MovesTheFacesOfABoxAndKeepsItABox) {
  EXPECT_NEAR(volume_mm3(offset_mesh(box({0, 0, 0}, {10, 20, 30}), 1.0)), 12.0 * 22.0 * 32.0, 0.01);
}

TEST(MirrorMesh, KeepsTheVolumeAndFacesOutwards) {
  const Mesh mirrored = mirror_mesh(box({0, 0, 0}, {1, 2, 3}), {Vector3d::UnitX(), 0.0});
  EXPECT_NEAR(volume_mm3(mirrored), 6.0, 1e-6);
  EXPECT_EQ(mirrored.vertices_mm[1].x(), -1.0F);
}

TEST(AlignFaces, PutsATurnedBoxIntoTheCornerOfTheAxes) {
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

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  const Mesh mesh = ball();
  const auto curvature = mean_curvature_per_mm(mesh);
  for (std::size_t i = 400; i < 2800; ++i)
    ASSERT_NEAR(curvature[i], 1.0 / kRadius, 0.003);
}

TEST(Selection, GrowsShrinksAndInverts) {
  const Mesh mesh = ball();
  const Selection cap = select_by_ball(mesh, {kRadius, 0, 0}, 8.0);
  const Selection larger = grow_selection(mesh, cap);
  EXPECT_GT(count_selected(larger), count_selected(cap));
  EXPECT_LE(count_selected(shrink_selection(mesh, larger)), count_selected(larger));
  EXPECT_EQ(count_selected(invert_selection(cap)), mesh.triangles.size() - count_selected(cap));
}

}  // namespace
}  // namespace frangia
