#include "frangia/editor/edit_preview.h"

#include <gtest/gtest.h>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remove_spikes.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::sphere;

Mesh coarse_ball() {
  return sphere(Vector3d::Zero(), 20.0, 30);
}

/// Moves the vertices of a ball outwards.
Mesh inflated(Mesh mesh, float by_mm) {
  for (auto& vertex : mesh.vertices_mm)
    vertex += by_mm * vertex.normalized();
  return mesh;
}

TEST(EditPreview, OfRemovedIslandsIsTheIslands) {
  Mesh mesh = coarse_ball();
  const std::size_t large = mesh.triangles.size();
  append_mesh(mesh, sphere({50, 0, 0}, 1.0, 6));
  const EditPreview preview = edit_preview(mesh, remove_islands(mesh, 5.0));
  ASSERT_EQ(preview.removed.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    ASSERT_EQ(preview.removed[t] != 0, t >= large);
  EXPECT_EQ(count_selected(preview.added), 0U);
}

TEST(EditPreview, OfAFilledHoleIsThePatch) {
  const Mesh open = delete_selected(coarse_ball(), select_by_ball(coarse_ball(), {20, 0, 0}, 6.0));
  const Mesh filled = fill_holes(open);
  const EditPreview preview = edit_preview(open, filled);
  EXPECT_EQ(count_selected(preview.removed), 0U);
  for (std::size_t t = 0; t < filled.triangles.size(); ++t)
    ASSERT_EQ(preview.added[t] != 0, t >= open.triangles.size());
}

TEST(EditPreview, OfARemovedSpikeIsTheTrianglesAtItsTip) {
  Mesh mesh = coarse_ball();
  mesh.vertices_mm[1000] *= 2.0F;
  const EditPreview preview = edit_preview(mesh, remove_spikes(mesh));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    ASSERT_EQ(preview.removed[t] != 0, a == 1000 || b == 1000 || c == 1000);
  }
}

TEST(EditPreview, IsEmptyForMovesWithinSigmaAndForFewerTriangles) {
  Mesh mesh = coarse_ball();
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.1F);
  for (const Mesh& after : {inflated(mesh, 0.05F), decimate(mesh, {.tolerance_mm = 0.05})}) {
    const EditPreview preview = edit_preview(mesh, after);
    EXPECT_EQ(count_selected(preview.removed), 0U);
    EXPECT_EQ(count_selected(preview.added), 0U);
  }
  const EditPreview far = edit_preview(mesh, inflated(mesh, 0.2F));
  EXPECT_EQ(count_selected(far.removed), mesh.triangles.size());
}

TEST(EditPreview, ShowsReversedTriangles) {
  const EditPreview preview = edit_preview(coarse_ball(), reverse_orientation(coarse_ball()));
  EXPECT_EQ(count_selected(preview.removed), coarse_ball().triangles.size());
}

TEST(EditPreview, OfAnEmptyResultIsEverything) {
  EXPECT_EQ(count_selected(edit_preview(coarse_ball(), Mesh()).removed),
            coarse_ball().triangles.size());
}

}  // namespace
}  // namespace frangia
