#include "frangia/mesh/internal/patch_intersections.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/change_selection.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/self_intersections.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::open_edges;

/// Two halves of a ball, apart by so much: their smooth fillings meet again.
Mesh halves(double apart_mm) {
  const Mesh ball = testing::sphere(Eigen::Vector3d::Zero(), 20.0, 40);
  const Eigen::AlignedBox3d band(Eigen::Vector3d(-30, -30, -0.5 * apart_mm),
                                 Eigen::Vector3d(30, 30, 0.5 * apart_mm));
  return delete_selected(ball, select_by_box(ball, band));
}

std::vector<HolePatch> patches_of(const Mesh& mesh, double curvature) {
  const HalfEdges edges(mesh);
  std::vector<HolePatch> patches;
  for (const BoundaryLoop& loop : boundary_loops(mesh, edges))
    patches.push_back(smooth_patch(mesh, edges, vertices_of(mesh, loop), {.curvature = curvature}));
  return patches;
}

TEST(PatchIntersections, AreCountedForEachPatchAndNoneWithoutCurvature) {
  const Mesh open = halves(6.0);
  const auto crossings = patch_intersections(open, patches_of(open, 1.0));
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_GT(crossings[0].all(), 0U);
  EXPECT_EQ(crossings[0].all(), crossings[1].all());  // each pair is one of both
  for (const PatchIntersections& count : patch_intersections(open, patches_of(open, 0.0)))
    EXPECT_EQ(count.all(), 0U);
}

TEST(FillHoles, FallsBackWhereASmoothFillingWouldIntersectTheSurface) {
  const Mesh open = halves(6.0);
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& note) { notes.push_back(note); };
  const Mesh filled = fill_holes(open, {}, run);
  EXPECT_TRUE(self_intersections(filled).empty());
  EXPECT_EQ(open_edges(filled), 0U);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("would cross"), std::string::npos);
}

TEST(FillHoles, EndsOverABoundaryThatIsCrumpled) {
  Mesh open = halves(4.0);
  for (const BoundaryLoop& loop : boundary_loops(open)) {
    const auto rim = vertices_of(open, loop);
    for (std::size_t i = 0; i < rim.size(); ++i)
      open.vertices_mm[rim[i]] *= i % 3 == 0 ? 0.4F : i % 3 == 1 ? 1.3F : 1.0F;
  }
  EXPECT_EQ(open_edges(fill_holes(open)), 0U);
}

}  // namespace
}  // namespace frangia
