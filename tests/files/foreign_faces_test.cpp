// Faces and vertices as other programs write them: concave polygons, and vertices for each corner.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "files/foreign_meshes.h"
#include "files/sample_meshes.h"
#include "support/mesh_checks.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::area_of;
using testing::dxf_of;
using testing::ForeignMeshes;
using testing::kArrow;
using testing::kU;
using testing::obj_of;
using testing::off_of;
using testing::ply_of;
using testing::prism;
using testing::Solid;
using testing::volume_of;

TEST_F(ForeignMeshes, ConcaveFacesKeepTheirAreaWhicheverCornerTheyBeginWith) {
  for (std::size_t start = 0; start < kU.size(); ++start) {
    const Solid solid = prism(kU, start);
    for (const Mesh& mesh : {read("u.obj", obj_of(solid)),
                             read("u.off", off_of(solid)),
                             read("u.ply", ply_of(solid)),
                             read("u.dxf", dxf_of(solid, false))}) {
      EXPECT_NEAR(area_of(mesh), 2200.0, 1e-3) << start;
      EXPECT_NEAR(volume_of(mesh), 4500.0, 1e-2) << start;
      EXPECT_EQ(testing::Edges(mesh).open, 0U);
      EXPECT_EQ(said(), "");
    }
  }
  const double perimeter = 2.0 * std::hypot(15, 10) + 2.0 * std::hypot(15, 30);
  for (std::size_t start = 0; start < kArrow.size(); ++start) {
    const Solid solid = prism(kArrow, start);
    for (const Mesh& mesh : {read("a.obj", obj_of(solid)),
                             read("a.off", off_of(solid)),
                             read("a.ply", ply_of(solid)),
                             read("a.dxf", dxf_of(solid, true))})
      EXPECT_NEAR(area_of(mesh), 600.0 + 10.0 * perimeter, 1e-3) << start;
  }
}

TEST_F(ForeignMeshes, FacesThatAreNotPlaneAreNamed) {
  Solid solid = prism(kU, 0);
  solid.vertices[4].z() = -2.0;  // a corner of the bottom and of two walls
  for (const auto& [name, text] : {std::pair("u.obj", obj_of(solid)),
                                   std::pair("u.off", off_of(solid)),
                                   std::pair("u.ply", ply_of(solid)),
                                   std::pair("u.dxf", dxf_of(solid, false))}) {
    static_cast<void>(read(name, text));
    EXPECT_TRUE(said("1 of its faces with more than three corners is not plane")) << said();
  }
  solid = prism(kU, 0);
  std::swap(solid.faces.back()[1], solid.faces.back()[4]);
  static_cast<void>(read("u.obj", obj_of(solid)));
  EXPECT_TRUE(said("the outline of 1 face crosses itself")) << said();
}

/// The solid with vertices of its own for each face.
Solid soup_of(const Solid& solid) {
  Solid soup;
  for (const auto& face : solid.faces) {
    std::vector<std::size_t> own;
    for (const std::size_t corner : face) {
      own.push_back(soup.vertices.size());
      soup.vertices.push_back(solid.vertices[corner]);
    }
    soup.faces.push_back(own);
  }
  return soup;
}

TEST_F(ForeignMeshes, ASoupIsJoinedWhereItsEdgesMeet) {
  const Solid soup = soup_of(prism(kU, 0));
  for (const auto& [name, text] : {std::pair("u.obj", obj_of(soup)),
                                   std::pair("u.off", off_of(soup)),
                                   std::pair("u.ply", ply_of(soup))}) {
    const Mesh mesh = read(name, text);
    EXPECT_EQ(mesh.vertices_mm.size(), 16U) << name;
    EXPECT_EQ(testing::Edges(mesh).open, 0U) << name;
    EXPECT_NEAR(volume_of(mesh), 4500.0, 1e-2);
    EXPECT_TRUE(said("vertices of their own; 48 vertices were joined to 16")) << said();
  }
  static_cast<void>(read("u.ply", ply_of(prism(kU, 0))));
  EXPECT_EQ(said(), "") << "shared vertices stay";
}

/// The number of parts that no vertex joins.
std::size_t parts_of(const Mesh& mesh) {
  std::vector<std::size_t> part(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < part.size(); ++i)
    part[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::size_t least = std::min({part[a], part[b], part[c]});
      for (const std::uint32_t corner : {a, b, c})
        changed = std::exchange(part[corner], least) != least || changed;
    }
  }
  std::sort(part.begin(), part.end());
  return static_cast<std::size_t>(std::unique(part.begin(), part.end()) - part.begin());
}

/// A cube of 12 mm whose sides are grids with vertices of their own, as programs write sharp edges
/// and seams of textures. With holes, each side lacks a face.
Solid cube_of_grids(bool with_holes) {
  constexpr int kCells = 4;
  Solid cube;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {0.0, 12.0}) {
      const std::size_t first = cube.vertices.size();
      for (int i = 0; i <= kCells; ++i) {
        for (int j = 0; j <= kCells; ++j) {
          Vector3d point;
          point[axis] = end;
          point[(axis + 1) % 3] = 3.0 * i;
          point[(axis + 2) % 3] = 3.0 * j;
          cube.vertices.push_back(point);
          if (i == kCells || j == kCells || (with_holes && i == 1 && j == 1)) continue;
          const std::size_t at = first + static_cast<std::size_t>(i * (kCells + 1) + j);
          std::vector<std::size_t> face{at, at + kCells + 1, at + kCells + 2, at + 1};
          if (end == 0.0) std::reverse(face.begin(), face.end());
          cube.faces.push_back(face);
        }
      }
    }
  }
  return cube;
}

TEST_F(ForeignMeshes, VerticesThatStandTwiceAtSeamsAreJoined) {
  const Solid cube = cube_of_grids(false);
  for (const auto& [name, text] : {std::pair("cube.obj", obj_of(cube)),
                                   std::pair("cube.off", off_of(cube)),
                                   std::pair("cube.ply", ply_of(cube))}) {
    const Mesh mesh = read(name, text);
    EXPECT_EQ(mesh.vertices_mm.size(), 98U) << name;
    EXPECT_EQ(testing::Edges(mesh).open, 0U) << name;
    EXPECT_NEAR(volume_of(mesh), 1728.0, 1e-2);
    EXPECT_TRUE(
        said("stand twice where faces meet, as at seams of normals or textures; 150 vertices "
             "were joined to 98"))
        << said();
  }
  // Holes stay.
  const Mesh open = read("open.obj", obj_of(cube_of_grids(true)));
  EXPECT_EQ(parts_of(open), 1U);
  EXPECT_EQ(testing::Edges(open).open, 24U);
}

TEST_F(ForeignMeshes, ClosedBodiesThatTouchStayApart) {
  const std::vector<Eigen::Vector2d> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  // Beside the first: at a corner, along an edge, with a whole side, and with another one.
  for (const Vector3d& step : {Vector3d(10, 10, 10),
                               Vector3d(10, 10, 0),
                               Vector3d(10, 0, 0),
                               Vector3d(0, 10, 0),
                               Vector3d(-10, 0, 0),
                               Vector3d(0, 0, 10)}) {
    Solid both = soup_of(prism(square, 0));
    const Solid other = soup_of(prism(square, 1));
    for (auto face : other.faces) {
      for (std::size_t& corner : face)
        corner += both.vertices.size();
      both.faces.push_back(face);
    }
    for (const Vector3d& vertex : other.vertices)
      both.vertices.push_back(vertex + step);
    const Mesh mesh = read("two.obj", obj_of(both));
    EXPECT_EQ(mesh.vertices_mm.size(), 16U) << step.transpose();
    EXPECT_EQ(parts_of(mesh), 2U) << step.transpose();
    EXPECT_EQ(testing::Edges(mesh).open, 0U) << step.transpose();
    EXPECT_EQ(testing::Edges(mesh).repeated, 0U) << step.transpose();
  }
}

TEST_F(ForeignMeshes, SeamsOfColorsStay) {
  const Solid soup = soup_of(prism(kU, 0));
  std::string text;
  std::size_t vertex = 0;
  for (const auto& face : soup.faces) {
    const bool is_cap = face.size() > 4;
    for (std::size_t i = 0; i < face.size(); ++i, ++vertex) {
      const Vector3d& v = soup.vertices[vertex];
      text += fmt::format("v {} {} {} {}\n", v.x(), v.y(), v.z(), is_cap ? "1 0 0" : "0 0 1");
    }
  }
  const std::string obj = obj_of(soup);
  const Mesh mesh = read("u.obj", text + obj.substr(obj.find("f ")));
  EXPECT_EQ(mesh.vertices_mm.size(), 32U) << "of the caps and of the walls";
  EXPECT_EQ(mesh.colors.size(), 32U);
  EXPECT_EQ(parts_of(mesh), 3U);
}

}  // namespace
}  // namespace frangia
