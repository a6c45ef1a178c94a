#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/geometry/components.h"
#include "frangia/geometry/connectivity.h"

namespace frangia {
namespace {

using Triangles = std::vector<Mesh::Triangle>;

/// Appends a cube of side 1 at whole coordinates to a mesh whose vertices are the points of a grid
/// of 4 x 4 x 4, so that cubes share them.
void add_cube(Mesh& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto at = [&](std::uint32_t corner) {
    return (x + (corner & 1U)) + 4 * (y + (corner >> 1U & 1U)) + 16 * (z + (corner >> 2U));
  };
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) {
    grid.triangles.push_back({at(a), at(b), at(c)});
    grid.triangles.push_back({at(a), at(c), at(d)});
  }
}

Mesh grid_of_cubes(const std::vector<std::array<std::uint32_t, 3>>& places) {
  Mesh grid;
  for (int i = 0; i < 64; ++i)
    grid.vertices_mm.emplace_back(
        static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
  for (const auto& [x, y, z] : places)
    add_cube(grid, x, y, z);
  return grid;
}

/// Removes the triangles of faces that two cubes have in common.
void remove_inner_faces(Mesh& grid) {
  const auto sorted = [](Mesh::Triangle triangle) {
    std::sort(triangle.begin(), triangle.end());
    return triangle;
  };
  std::map<Mesh::Triangle, int> times;
  for (const Mesh::Triangle& triangle : grid.triangles)
    ++times[sorted(triangle)];
  std::erase_if(grid.triangles,
                [&](const Mesh::Triangle& triangle) { return times[sorted(triangle)] > 1; });
}

std::size_t odd_edges(const Mesh& mesh) {
  const HalfEdges edges(mesh);
  std::size_t odd = 0;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    odd += edges.has_twin(edge) || edges.is_boundary(edge) ? 0U : 1U;
  return odd;
}

std::size_t shells(const Mesh& mesh) {
  return connected_components(mesh).components.size();
}

/// The same surface: the corners of its triangles have not moved.
void expect_same_places(const Mesh& mesh, const Mesh& before) {
  ASSERT_EQ(mesh.triangles.size(), before.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.vertices_mm[mesh.triangles[i].at(k)],
                before.vertices_mm[before.triangles[i].at(k)]);
}

TEST(SeparateShells, KeepsCubesApartThatShareAnEdgeACornerOrAFace) {
  for (const auto& second : std::vector<std::array<std::uint32_t, 3>>{
           {1, 1, 0}, {1, 1, 1}, {1, 0, 0}, {0, 1, 1}, {0, 0, 1}}) {
    const Mesh before = grid_of_cubes({{0, 0, 0}, second});
    const Mesh mesh = separate_shells(before);
    expect_same_places(mesh, before);
    EXPECT_EQ(shells(mesh), 2U);
    EXPECT_EQ(odd_edges(mesh), 0U);
  }
}

TEST(SeparateShells, KeepsThemApartWhereTheyAreInsideOut) {
  for (const auto& second :
       std::vector<std::array<std::uint32_t, 3>>{{1, 1, 0}, {1, 1, 1}, {1, 0, 0}}) {
    Mesh before = grid_of_cubes({{0, 0, 0}, second});
    for (Mesh::Triangle& triangle : before.triangles)
      std::swap(triangle[1], triangle[2]);
    const Mesh mesh = separate_shells(before);
    EXPECT_EQ(shells(mesh), 2U);
    EXPECT_EQ(odd_edges(mesh), 0U);
  }
}

TEST(SeparateShells, SplitsTheEdgeAtWhichABodyTouchesItself) {
  // An arch: its two feet meet in an edge, and the cubes above them are one body.
  Mesh before = grid_of_cubes({{0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}});
  remove_inner_faces(before);
  ASSERT_GT(odd_edges(before), 0U);
  const Mesh mesh = separate_shells(before);
  expect_same_places(mesh, before);
  EXPECT_EQ(odd_edges(mesh), 0U);
  EXPECT_EQ(shells(mesh), 1U);
}

TEST(SeparateShells, LeavesAMeshAsItIsWhereNothingTouches) {
  const Mesh before = grid_of_cubes({{0, 0, 0}, {2, 2, 2}});
  const Mesh mesh = separate_shells(before);
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.vertices_mm, before.vertices_mm);
}

TEST(SeparateShells, LeavesThreeSheetsAtOneEdgeTogether) {
  Mesh sheets;
  sheets.vertices_mm = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  sheets.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_EQ(separate_shells(sheets).triangles, sheets.triangles);
}

TEST(SeparateShells, LeavesTrianglesOfOppositeSenseTogether) {
  Mesh sheet;
  sheet.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 2, 3}};  // both run from 1 to 2
  EXPECT_EQ(separate_shells(sheet).triangles, sheet.triangles);
}

TEST(SeparateShells, SeparatesTrianglesThatShareAVertexAlone) {
  Mesh bow;
  bow.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  bow.triangles = {{0, 1, 2}, {0, 3, 4}};
  bow.triangle_marks = {Mark::Measured, Mark::Synthesized};
  const Mesh mesh = separate_shells(bow);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {5, 3, 4}}));
  EXPECT_EQ(mesh.vertices_mm.back(), bow.vertices_mm.front());
  EXPECT_EQ(mesh.triangle_marks, bow.triangle_marks);
}

}  // namespace
}  // namespace frangia
