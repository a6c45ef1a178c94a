#include <cmath>

#include <gtest/gtest.h>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/selection.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/internal/smooth_patch.h"
#include "frangia/mesh/self_intersections.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::open_edges;

/// Two halves of a ball with a gap: their smooth patches intersect each other.
Mesh halves(double gap_mm) {
  const Mesh ball = testing::sphere(Eigen::Vector3d::Zero(), 20.0, 40);
  const Eigen::AlignedBox3d band(Eigen::Vector3d(-30, -30, -0.5 * gap_mm),
                                 Eigen::Vector3d(30, 30, 0.5 * gap_mm));
  return delete_selected(ball, select_by_box(ball, band));
}

std::vector<HolePatch> patches_of(const Mesh& mesh, double curvature) {
  const HalfEdges edges(mesh);
  std::vector<HolePatch> patches;
  for (const BoundaryLoop& loop : boundary_loops(mesh, edges))
    patches.push_back(smooth_patch(mesh, edges, vertices_of(mesh, loop), {.curvature = curvature}));
  return patches;
}

TEST(PatchIntersections, CountsForEachPatchAndFindsNoneOfMinimalSurfaces) {
  const Mesh open = halves(6.0);
  const auto crossings = patch_intersections(open, patches_of(open, 1.0));
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_GT(crossings[0].all(), 0U);
  EXPECT_EQ(crossings[0].all(), crossings[1].all());  // each pair counts for both
  for (const PatchIntersections& count : patch_intersections(open, patches_of(open, 0.0)))
    EXPECT_EQ(count.all(), 0U);
}

TEST(FillHoles, AvoidsIntersectionsByASmallerCurvature) {
  const Mesh open = halves(6.0);
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& note) { notes.push_back(note); };
  const Mesh filled = fill_holes(open, {}, run);
  EXPECT_TRUE(self_intersections(filled).empty());
  EXPECT_EQ(open_edges(filled), 0U);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("would intersect"), std::string::npos);
}

TEST(FillHoles, EndsOverACrumpledBoundary) {
  Mesh open = halves(4.0);
  for (const BoundaryLoop& loop : boundary_loops(open)) {
    const auto boundary = vertices_of(open, loop);
    for (std::size_t i = 0; i < boundary.size(); ++i)
      open.vertices_mm[boundary[i]] *= i % 3 == 0 ? 0.4F : i % 3 == 1 ? 1.3F : 1.0F;
  }
  EXPECT_EQ(open_edges(fill_holes(open)), 0U);
}

}  // namespace
}  // namespace frangia
