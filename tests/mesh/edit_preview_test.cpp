#include "frangia/mesh/edit_preview.h"

#include <gtest/gtest.h>

#include "frangia/mesh/change_selection.h"
#include "frangia/mesh/connected_parts.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remove_spikes.h"
#include "frangia/mesh/select_by_place.h"
#include "frangia/mesh/vertex_data.h"

#include "support/mesh_truths.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::sphere;

Mesh coarse_ball() {
  return sphere(Vector3d::Zero(), 20.0, 30);
}

/// The ball's vertices farther out.
Mesh swollen(Mesh mesh, float by_mm) {
  for (auto& vertex : mesh.vertices_mm)
    vertex += by_mm * vertex.normalized();
  return mesh;
}

TEST(EditPreview, OfIslandsIsTheIslands) {
  Mesh mesh = coarse_ball();
  const std::size_t large = mesh.triangles.size();
  append_mesh(mesh, sphere({50, 0, 0}, 1.0, 6));
  const EditPreview preview = edit_preview(mesh, remove_islands(mesh, 5.0));
  ASSERT_EQ(preview.going.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    ASSERT_EQ(preview.going[t] != 0, t >= large);
  EXPECT_EQ(count_of(preview.coming), 0U);
}

TEST(EditPreview, OfAFilledHoleIsThePatch) {
  const Mesh open = delete_selected(coarse_ball(), select_by_ball(coarse_ball(), {20, 0, 0}, 6.0));
  const Mesh filled = fill_holes(open);
  const EditPreview preview = edit_preview(open, filled);
  EXPECT_EQ(count_of(preview.going), 0U);
  for (std::size_t t = 0; t < filled.triangles.size(); ++t)
    ASSERT_EQ(preview.coming[t] != 0, t >= open.triangles.size());
}

TEST(EditPreview, OfASpikeIsWhatIsAtItsTip) {
  Mesh mesh = coarse_ball();
  mesh.vertices_mm[1000] *= 2.0F;
  const EditPreview preview = edit_preview(mesh, remove_spikes(mesh));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    ASSERT_EQ(preview.going[t] != 0, a == 1000 || b == 1000 || c == 1000);
  }
}

TEST(EditPreview, OfMovesWithinSigmaAndOfFewerTrianglesIsEmpty) {
  Mesh mesh = coarse_ball();
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.1F);
  for (const Mesh& after : {swollen(mesh, 0.05F), decimate(mesh, {.tolerance_mm = 0.05})}) {
    const EditPreview preview = edit_preview(mesh, after);
    EXPECT_EQ(count_of(preview.going), 0U);
    EXPECT_EQ(count_of(preview.coming), 0U);
  }
  const EditPreview far = edit_preview(mesh, swollen(mesh, 0.2F));
  EXPECT_EQ(count_of(far.going), mesh.triangles.size());
}

TEST(EditPreview, SeesWhatIsTurnedRound) {
  const EditPreview preview = edit_preview(coarse_ball(), turn_inside_out(coarse_ball()));
  EXPECT_EQ(count_of(preview.going), coarse_ball().triangles.size());
}

TEST(EditPreview, OfAnEmptyMeshIsEverything) {
  EXPECT_EQ(count_of(edit_preview(coarse_ball(), Mesh()).going), coarse_ball().triangles.size());
}

}  // namespace
}  // namespace frangia
