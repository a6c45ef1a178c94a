// Colors of vertices through the operations that create or remove vertices.
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/cut_by_plane.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/remesh_isotropic.h"

#include "support/test_meshes.h"

namespace frangia::colors_in_operations {
namespace {

/// A color that is linear in the position, on a sphere of radius 20.
VertexColor color_at(const Eigen::Vector3f& p) {
  const auto channel = [](float v) {
    return static_cast<std::uint8_t>(std::lround(128.0F + 5.0F * v));
  };
  return {channel(p.x()), channel(p.y()), channel(p.z())};
}

Mesh colored_ball() {
  Mesh mesh = testing::sphere({0.0, 0.0, 0.0}, 20.0, 40);
  for (const auto& vertex : mesh.vertices_mm)
    mesh.colors.push_back(color_at(vertex));
  return mesh;
}

/// The largest difference of a channel from that of the vertex's place.
int worst_color(const Mesh& mesh) {
  EXPECT_EQ(mesh.colors.size(), mesh.vertices_mm.size());
  int worst = 0;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    const VertexColor truth = color_at(mesh.vertices_mm[i]);
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(int{mesh.colors[i].at(c)} - int{truth.at(c)}));
  }
  return worst;
}

TEST(ColorsInOperations, DecimationInterpolatesAlongTheCollapsedEdges) {
  const Mesh mesh = decimate(colored_ball(), {.triangles = 1200});
  EXPECT_LE(mesh.triangles.size(), 1200U);
  EXPECT_LE(worst_color(mesh), 10)
      << "of 200; an edge is 3 mm long, over which colors change by 15";
}

TEST(ColorsInOperations, RemeshingInterpolatesInTheTriangles) {
  const Mesh mesh = remesh_isotropic(colored_ball(), {.edge_mm = 2.0});
  EXPECT_LE(worst_color(mesh), 4);
}

TEST(ColorsInOperations, FilledHolesContinueTheColorsAround) {
  Mesh mesh = colored_ball();
  std::vector<std::uint8_t> keep;
  for (const auto& t : mesh.triangles)
    keep.push_back(mesh.vertices_mm[t[0]].z() < 17.0F ? 1 : 0);
  keep_triangles(mesh, keep);
  const std::size_t before = mesh.vertices_mm.size();
  mesh = fill_holes(std::move(mesh), {});
  ASSERT_GT(mesh.vertices_mm.size(), before);
  EXPECT_LE(worst_color(mesh), 25) << "the top is 3 mm above the rim: 15, and x and y vary by 100";
}

TEST(ColorsInOperations, CutsInterpolateAlongTheEdges) {
  Mesh mesh = colored_ball();
  const auto before = mesh.vertices_mm.size();
  mesh =
      cut_by_plane(std::move(mesh), Eigen::Hyperplane<double, 3>(Eigen::Vector3d::UnitZ(), -3.3));
  EXPECT_NE(mesh.vertices_mm.size(), before);
  EXPECT_LE(worst_color(mesh), 1);
}

TEST(ColorsInOperations, JoinedMeshesKeepThemAndOthersAreUnknown) {
  Mesh mesh = colored_ball();
  const std::size_t own = mesh.vertices_mm.size();
  append_mesh(mesh, testing::box({30.0F, 0.0F, 0.0F}, {40.0F, 10.0F, 10.0F}));
  ASSERT_EQ(mesh.colors.size(), own + 8);
  EXPECT_EQ(mesh.colors[own], kUnknownColor);
  EXPECT_EQ(mesh.colors[7], color_at(mesh.vertices_mm[7]));
  mesh.triangles.resize(20);
  remove_unused_vertices(mesh);
  EXPECT_EQ(worst_color(mesh), 0);
}

}  // namespace
}  // namespace frangia::colors_in_operations
