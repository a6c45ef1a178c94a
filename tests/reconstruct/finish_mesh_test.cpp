#include "frangia/reconstruct/finish_mesh.h"

#include <algorithm>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
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
  const Mesh closed = finish_mesh(open, {.watertight = true}, run).mesh;
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
  const Mesh fewer = finish_mesh(mesh, {.tolerance_mm = 0.05}).mesh;
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

/// A square of `cells` x `cells` cells of 1 mm at a height.
Mesh sheet(std::uint32_t cells, float z_mm, float sigma_mm) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x)
      mesh.vertices_mm.emplace_back(static_cast<float>(x), static_cast<float>(y), z_mm);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), sigma_mm);
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * (cells + 1) + x;
      mesh.triangles.push_back({a, a + 1, a + cells + 2});
      mesh.triangles.push_back({a, a + cells + 2, a + cells + 1});
    }
  }
  return mesh;
}

TEST(FinishMesh, RemovesIslandsOfAFewVoxelsOrOfTheirSigmaAndCountsThem) {
  Mesh mesh = sheet(80, 0.0F, 0.02F);
  append_mesh(mesh, sheet(4, 5.0F, 0.02F));    // 5.7 mm
  append_mesh(mesh, sheet(20, 10.0F, 15.0F));  // 28 mm, less than 2 x 15 mm
  append_mesh(mesh, sheet(20, 15.0F, 0.02F));
  std::string notes;
  frangia::Run run;
  run.on_note = [&](const std::string& text) { notes += text; };
  const FinishedMesh finished = finish_mesh(mesh, {}, run);
  EXPECT_EQ(finished.removed.count, 2U);
  EXPECT_EQ(finished.removed.triangles, 2U * (4U * 4U + 20U * 20U));
  EXPECT_GT(finished.removed.largest_mm, 28.0);
  EXPECT_EQ(finished.mesh.triangles.size(), 2U * (80U * 80U + 20U * 20U));
  EXPECT_NE(notes.find("2 of 4 components removed"), std::string::npos) << notes;
  EXPECT_NE(notes.find("832 triangles"), std::string::npos) << notes;
  EXPECT_EQ(finish_mesh(mesh, {.keep_islands = true}).mesh.triangles.size(), mesh.triangles.size());
  // Alone, an island is all that was measured.
  EXPECT_EQ(finish_mesh(sheet(4, 0.0F, 0.02F), {}).mesh.triangles.size(), 32U);
}

TEST(FinishMesh, LimitsTheTrianglesLast) {
  const Mesh mesh = make_part("bracket");
  const FinishOptions options{.watertight = true, .tolerance_mm = 1e-4, .max_triangles = 3000};
  const Mesh limited = finish_mesh(mesh, options).mesh;
  EXPECT_LE(limited.triangles.size(), 3000U);
  EXPECT_GT(limited.triangles.size(), 2000U);
  EXPECT_EQ(finish_mesh(mesh, {.max_triangles = kMostTriangles}).mesh.triangles.size(),
            mesh.triangles.size());
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
