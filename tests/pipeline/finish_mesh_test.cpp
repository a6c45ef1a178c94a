#include "frangia/pipeline/finish_mesh.h"

#include <algorithm>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

/// The built-in bracket without its base: open below.
Mesh open_bracket() {
  Mesh mesh = make_part("bracket");
  const auto below = [&](const Mesh::Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
      return mesh.vertices_mm[v].z() < 0.5F;
    });
  };
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), below),
                       mesh.triangles.end());
  remove_unused_vertices(mesh);
  mesh.normals.clear();
  return mesh;
}

TEST(FinishMesh, ClosesAndMarksWhatItSynthesizes) {
  const Mesh open = open_bracket();
  ASSERT_FALSE(boundary_loops(open).empty());
  std::string notes;
  frangia::Run run;
  run.on_note = [&](const std::string& text) { notes += text; };
  const Mesh closed = finish_mesh(open, {.watertight = true}, run);
  EXPECT_TRUE(boundary_loops(closed).empty());
  EXPECT_EQ(count_non_manifold_edges(closed), 0U);
  ASSERT_EQ(closed.triangle_marks.size(), closed.triangles.size());
  const auto synthesized =
      std::count(closed.triangle_marks.begin(), closed.triangle_marks.end(), Mark::Synthesized);
  EXPECT_EQ(static_cast<std::size_t>(synthesized), closed.triangles.size() - open.triangles.size());
  EXPECT_NE(notes.find("marked as synthesized"), std::string::npos);
}

TEST(FinishMesh, StopsWhenItIsCancelledWhileItFillsHoles) {
  std::stop_source source;
  frangia::Run run;
  run.stop = source.get_token();
  run.progress = [&](double /*done*/) { source.request_stop(); };
  try {
    static_cast<void>(finish_mesh(open_bracket(), {.watertight = true}, run));
    FAIL() << "the request to stop was ignored";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Cancelled);
  }
}

TEST(FinishMesh, StaysWithinTheTolerance) {
  const Mesh mesh = make_part("bracket");
  const Mesh fewer = finish_mesh(mesh, {.tolerance_mm = 0.05});
  EXPECT_LT(fewer.triangles.size(), mesh.triangles.size() / 2);
  const RayScene before(mesh);
  const RayScene after(fewer);
  double farthest = 0.0;
  for (const auto& vertex : mesh.vertices_mm)
    farthest = std::max(farthest, after.nearest(vertex.cast<double>())->distance_mm);
  for (const auto& vertex : fewer.vertices_mm)
    farthest = std::max(farthest, before.nearest(vertex.cast<double>())->distance_mm);
  EXPECT_LE(farthest, 0.05);
}

TEST(LimitTriangles, KeepsTheCountAndNotesTheDistance) {
  const Mesh mesh = make_part("bracket");
  std::string notes;
  frangia::Run run;
  run.on_note = [&](const std::string& text) { notes += text; };
  EXPECT_LE(limit_triangles(mesh, 5000, run).triangles.size(), 5000U);
  EXPECT_NE(notes.find("mm"), std::string::npos);
  EXPECT_EQ(limit_triangles(mesh, 0).triangles.size(), mesh.triangles.size());
}

}  // namespace
}  // namespace frangia
