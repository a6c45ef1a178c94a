#include "frangia/mesh/make_manifold.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/geometry/components.h"
#include "frangia/geometry/connectivity.h"

namespace frangia {
namespace {

using Place = std::array<std::uint32_t, 3>;

/// Unit cubes at whole coordinates, whose corners are points of a grid of 4 x 4 x 4, so that cubes
/// that touch share them.
Mesh cubes_at(const std::vector<Place>& places) {
  Mesh grid;
  for (int i = 0; i < 64; ++i)
    grid.vertices_mm.emplace_back(
        static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [x, y, z] : places) {
    const auto at = [x = x, y = y, z = z](std::uint32_t corner) {
      return (x + (corner & 1U)) + 4 * (y + (corner >> 1U & 1U)) + 16 * (z + (corner >> 2U));
    };
    for (const auto& [a, b, c, d] : kFaces) {
      grid.triangles.push_back({at(a), at(b), at(c)});
      grid.triangles.push_back({at(a), at(c), at(d)});
    }
  }
  return grid;
}

void add_backs(Mesh& mesh, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({a, c, b});
  }
}

/// A sheet of 2 x side triangles.
Mesh strip(std::uint32_t side) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= side; ++i) {
    mesh.vertices_mm.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
    mesh.vertices_mm.emplace_back(static_cast<float>(i), 1.0F, 0.0F);
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    mesh.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  return mesh;
}

double volume_of(const Mesh& mesh) {
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += mesh.vertices_mm[a].cast<double>().dot(
        mesh.vertices_mm[b].cast<double>().cross(mesh.vertices_mm[c].cast<double>()));
  return six / 6.0;
}

bool is_closed(const Mesh& mesh) {
  const HalfEdges edges(mesh);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge)
    if (!edges.has_twin(edge)) return false;
  return true;
}

TEST(MakeManifoldOfBodies, KeepsThoseThatTouchClosedAndApart) {
  for (const Place& second : {Place{1, 1, 0}, Place{1, 1, 1}, Place{1, 0, 0}}) {
    Mesh mesh = cubes_at({{0, 0, 0}, second});
    for (const double sign : {1.0, -1.0}) {
      const Mesh split = make_manifold(mesh);
      EXPECT_TRUE(is_closed(split));
      EXPECT_EQ(split.triangles.size(), 24U);
      EXPECT_EQ(connected_components(split).components.size(), 2U);
      EXPECT_NEAR(volume_of(split), sign * 2.0, 1e-6);
      for (Mesh::Triangle& triangle : mesh.triangles)
        std::swap(triangle[1], triangle[2]);
    }
  }
  const Mesh row = make_manifold(cubes_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}));
  EXPECT_TRUE(is_closed(row));
  EXPECT_EQ(connected_components(row).components.size(), 4U);
  EXPECT_NEAR(volume_of(row), 4.0, 1e-6);
}

TEST(MakeManifoldOfBodies, RemovesTheBacksOfADoubleSidedOne) {
  Mesh mesh = cubes_at({{0, 0, 0}});
  add_backs(mesh, mesh.triangles.size());
  const Mesh split = make_manifold(mesh);
  EXPECT_TRUE(is_closed(split));
  EXPECT_EQ(split.triangles.size(), 12U);
  EXPECT_NEAR(volume_of(split), 1.0, 1e-6) << "the earlier triangles stay";
}

TEST(MakeManifoldOfBodies, RemovesTheBacksOfADoubleSidedSheet) {
  const Mesh sheet = strip(5);
  for (const std::size_t backs : {10U, 4U, 1U}) {  // of the sheet, of a part of it
    Mesh mesh = sheet;
    add_backs(mesh, backs);
    EXPECT_EQ(make_manifold(mesh).triangles, sheet.triangles) << backs;
  }
}

TEST(MakeManifoldOfBodies, RemovesTrianglesThatStandTwice) {
  const Mesh cube = cubes_at({{0, 0, 0}});
  Mesh mesh = cube;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto [a, b, c] = cube.triangles[i];
    mesh.triangles.push_back({b, c, a});
  }
  const Mesh once = make_manifold(mesh);
  EXPECT_EQ(once.triangles.size(), 12U);
  EXPECT_TRUE(is_closed(once));
  EXPECT_NEAR(volume_of(once), 1.0, 1e-6);
}

}  // namespace
}  // namespace frangia
