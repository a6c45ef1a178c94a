// Meshes as other programs write them: concave faces, vertices for each corner, odd text and bytes.
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/files/internal/zip_file.h"
#include "frangia/files/read_mesh.h"

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"
#include "support/mesh_checks.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Faces = std::vector<std::vector<std::size_t>>;

struct Solid {
  std::vector<Vector3d> vertices;
  Faces faces;
};

/// A prism of height 10 over an outline, whose caps begin with any corner.
Solid prism(const std::vector<Eigen::Vector2d>& outline, std::size_t start) {
  const std::size_t count = outline.size();
  Solid solid;
  for (const double z : {0.0, 10.0})
    for (const Eigen::Vector2d& point : outline)
      solid.vertices.emplace_back(point.x(), point.y(), z);
  std::vector<std::size_t> bottom;
  std::vector<std::size_t> top;
  for (std::size_t i = 0; i < count; ++i) {
    bottom.push_back((2 * count - 1 - i - start) % count);
    top.push_back(count + (i + start) % count);
    solid.faces.push_back({i, (i + 1) % count, (i + 1) % count + count, i + count});
  }
  solid.faces.push_back(bottom);
  solid.faces.push_back(top);
  return solid;
}

/// A U of 30 x 20 with a notch of 10 x 15.
const std::vector<Eigen::Vector2d> kU{
    {0, 0}, {30, 0}, {30, 20}, {20, 20}, {20, 5}, {10, 5}, {10, 20}, {0, 20}};
/// An arrowhead, which is a concave quadrilateral.
const std::vector<Eigen::Vector2d> kArrow{{0, 0}, {15, 10}, {30, 0}, {15, 30}};

std::string obj_of(const Solid& solid) {
  std::string text;
  for (const Vector3d& v : solid.vertices)
    text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& face : solid.faces) {
    text += "f";
    for (const std::size_t corner : face)
      text += fmt::format(" {}", corner + 1);
    text += "\n";
  }
  return text;
}

std::string list_of_faces(const Solid& solid) {
  std::string text;
  for (const Vector3d& v : solid.vertices)
    text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& face : solid.faces) {
    text += fmt::format("{}", face.size());
    for (const std::size_t corner : face)
      text += fmt::format(" {}", corner);
    text += "\n";
  }
  return text;
}

std::string off_of(const Solid& solid) {
  return fmt::format("OFF\n{} {} 0\n", solid.vertices.size(), solid.faces.size()) +
         list_of_faces(solid);
}

std::string ply_of(const Solid& solid) {
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
             "property float z\nelement face {}\nproperty list uchar int vertex_indices\n"
             "end_header\n",
             solid.vertices.size(),
             solid.faces.size()) +
         list_of_faces(solid);
}

std::string group(int code, const std::string& value) {
  return fmt::format("{}\n{}\n", code, value);
}

std::string point_group(int corner, const Vector3d& v) {
  return group(10 + corner, fmt::format("{}", v.x())) +
         group(20 + corner, fmt::format("{}", v.y())) +
         group(30 + corner, fmt::format("{}", v.z()));
}

std::string drawing(const std::string& entities, const std::string& before = {}) {
  return before + group(0, "SECTION") + group(2, "ENTITIES") + entities + group(0, "ENDSEC") +
         group(0, "EOF");
}

/// A MESH, or 3DFACEs where all faces have four corners.
std::string dxf_of(const Solid& solid, bool quads) {
  std::string text;
  if (quads) {
    for (const auto& face : solid.faces) {
      text += group(0, "3DFACE") + group(8, "0");
      for (int k = 0; k < 4; ++k)
        text += point_group(k, solid.vertices[face[static_cast<std::size_t>(k)]]);
    }
    return drawing(text);
  }
  text = group(0, "MESH") + group(8, "0") + group(91, "0") +
         group(92, std::to_string(solid.vertices.size()));
  for (const Vector3d& v : solid.vertices)
    text += point_group(0, v);
  std::size_t entries = 0;
  std::string list;
  for (const auto& face : solid.faces) {
    entries += 1 + face.size();
    list += group(90, std::to_string(face.size()));
    for (const std::size_t corner : face)
      list += group(90, std::to_string(corner));
  }
  return drawing(text + group(93, std::to_string(entries)) + list);
}

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d p = mesh.vertices_mm[a].cast<double>();
    area += 0.5 * (mesh.vertices_mm[b].cast<double>() - p)
                      .cross(mesh.vertices_mm[c].cast<double>() - p)
                      .norm();
  }
  return area;
}

double volume_of(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices_mm[a].cast<double>().dot(
                  mesh.vertices_mm[b].cast<double>().cross(mesh.vertices_mm[c].cast<double>())) /
              6.0;
  return volume;
}

class ForeignMeshes : public testing::FolderFixture {
 protected:
  /// Reads a text as a file of that name, with what the reader warns of.
  Mesh read(const std::string& name, const std::string& bytes) {
    said_.clear();
    Run run;
    run.on_warning = [&](const std::string& sentence) { said_ += sentence + "\n"; };
    return read_mesh(put(name, bytes), run);
  }
  [[nodiscard]] bool said(const std::string& words) const {
    return said_.find(words) != std::string::npos;
  }
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  std::string said_;
};

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

TEST_F(ForeignMeshes, ObjStatementsGoOnBehindABackslashAndEndAtAComment) {
  const std::string vertices = "v 0 0 0\nv 1 0 0 # corner\nv 1 1 \\\n 0\r\nv 0 1\\\n 0\n";
  for (const char* faces : {"f 1 2 3 4 # side\n",
                            "f 1 2 \\\n 3 4\n",
                            "f 1 2\\\r\n 3 4\n",
                            "fo 1 2 3 4\n",
                            "f 1/ 2/ 3/ 4/\n"}) {
    const Mesh mesh = read("a.obj", vertices + faces);
    EXPECT_EQ(mesh.vertices_mm.size(), 4U) << faces;
    EXPECT_EQ(mesh.triangles.size(), 2U) << faces;
  }
  EXPECT_FLOAT_EQ(read("a.obj", "v 1.5D+01 2d0 -3D-1\n").vertices_mm[0].x(), 15.0F);
}

/// The text in UTF-16, low byte first or last, with its mark.
std::string utf16_of(const std::string& text, bool big_endian) {
  std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char letter : text)
    bytes += big_endian ? std::string{'\0', letter} : std::string{letter, '\0'};
  return bytes;
}

std::string stl_text(const Mesh& mesh, const char* end_loop, const char* end_solid) {
  std::string text = "solid part\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : triangle) {
      const auto& v = mesh.vertices_mm[corner];
      text += fmt::format("vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += fmt::format("{}\nendfacet\n", end_loop);
  }
  return text + end_solid + " part\n";
}

TEST_F(ForeignMeshes, TextsInOtherEncodingsAndWithOtherLineEndsAreRead) {
  const Mesh truth = testing::sheet(4);
  const std::string stl = stl_text(truth, "endloop", "endsolid");
  std::string old_mac = stl;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (const std::string& text :
       {"\xEF\xBB\xBF" + stl, old_mac, stl + stl, stl_text(truth, "end loop", "end solid")})
    EXPECT_GE(read("a.stl", text).triangles.size(), truth.triangles.size());
  const std::string obj = obj_of(prism(kU, 0));
  std::string mac_obj = obj;
  std::replace(mac_obj.begin(), mac_obj.end(), '\n', '\r');
  for (const std::string& text :
       {"\xEF\xBB\xBF" + obj, mac_obj, utf16_of(obj, false), utf16_of(obj, true)})
    EXPECT_NEAR(area_of(read("a.obj", text)), 2200.0, 1e-3);
}

std::string stl_binary(const Mesh& mesh, std::uint32_t stated, const std::string& head) {
  std::string bytes = head + std::string(80 - head.size(), ' ');
  bytes.append(reinterpret_cast<const char*>(&stated), 4);
  for (const auto& triangle : mesh.triangles) {
    bytes.append(12, '\0');
    for (const std::uint32_t corner : triangle)
      bytes.append(reinterpret_cast<const char*>(mesh.vertices_mm[corner].data()), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST_F(ForeignMeshes, BytesBehindTheLastFacetOfAnStlAreLeftOutInASentence) {
  const Mesh truth = testing::sheet(4);
  const auto count = static_cast<std::uint32_t>(truth.triangles.size());
  for (const std::string& tail :
       {std::string("\n"), std::string(2, '\0'), std::string(176, '\0')}) {
    EXPECT_EQ(read("a.stl", stl_binary(truth, count, "x") + tail).triangles.size(), count);
    EXPECT_TRUE(said(fmt::format("{} bytes behind its last facet", tail.size()))) << said();
  }
  for (const std::uint32_t stated : {0U, 0xFFFFFFFFU}) {
    EXPECT_EQ(read("a.stl", stl_binary(truth, stated, "solid x")).triangles.size(), count);
    EXPECT_TRUE(said("states no number of facets")) << said();
  }
  for (const std::uint32_t stated : {count - 1, count + 1}) {
    const auto path = put("a.stl", stl_binary(truth, stated, "x"));
    EXPECT_NE(testing::error_of([&] { return read_mesh(path); }).find("its header states"),
              std::string::npos);
  }
}

TEST_F(ForeignMeshes, EveryUnitOfADxfIsConverted) {
  const std::string face = group(0, "3DFACE") + point_group(0, {0, 0, 0}) +
                           point_group(1, {1, 0, 0}) + point_group(2, {0, 1, 0});
  const auto side_of = [&](int unit) {
    const std::string header = group(0, "SECTION") + group(2, "HEADER") + group(9, "$INSUNITS") +
                               group(70, std::to_string(unit)) + group(0, "ENDSEC");
    return static_cast<double>(read("a.dxf", drawing(face, header)).vertices_mm[1].x());
  };
  const std::vector<std::pair<int, double>> units{
      {0, 1.0},    {1, 25.4},  {2, 304.8}, {3, 1609344.0},  {4, 1.0},
      {5, 10.0},   {6, 1e3},   {7, 1e6},   {8, 25.4e-6},    {9, 0.0254},
      {10, 914.4}, {11, 1e-7}, {12, 1e-6}, {13, 1e-3},      {14, 100.0},
      {15, 1e4},   {16, 1e5},  {17, 1e12}, {20, 3.0857e19}, {21, 304.8006096}};
  for (const auto& [unit, mm] : units)
    EXPECT_NEAR(side_of(unit) / mm, 1.0, 1e-5) << unit;
  EXPECT_EQ(side_of(99), 1.0);
  EXPECT_TRUE(said("$INSUNITS 99 is no unit")) << said();
}

TEST_F(ForeignMeshes, WhatADrawingDoesNotShowIsLeftOutAndCounted) {
  const auto face = [](const std::string& layer, const char* space) {
    return group(0, "3DFACE") + group(8, layer) + group(67, space) + point_group(0, {0, 0, 0}) +
           point_group(1, {1, 0, 0}) + point_group(2, {0, 1, 0});
  };
  const auto layer = [](const std::string& name, const char* flags, const char* color) {
    return group(0, "LAYER") + group(2, name) + group(70, flags) + group(62, color);
  };
  const std::string tables = group(0, "SECTION") + group(2, "TABLES") + layer("on", "0", "7") +
                             layer("off", "0", "-7") + layer("frozen", "1", "7") +
                             group(0, "ENDSEC");
  const Mesh mesh = read(
      "a.dxf",
      drawing(face("on", "0") + face("off", "0") + face("frozen", "0") + face("on", "1"), tables));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_TRUE(said("left out 2 meshes of layers that are off or frozen, 1 mesh of paper space"))
      << said();
  const auto path = put("b.dxf", drawing(face("off", "0"), tables));
  EXPECT_NE(testing::error_of([&] {
              return read_mesh(path);
            }).find("only 1 mesh of layers that are off or frozen"),
            std::string::npos);
}

std::string pcd_of(const std::string& fields, const std::string& types, const std::string& data) {
  std::string sizes;
  std::string counts;
  for (const char type : types) {
    if (type == ' ') continue;
    sizes += " 4";
    counts += " 1";
  }
  return "VERSION 0.7\nFIELDS " + fields + "\nSIZE" + sizes + "\nTYPE " + types + "\nCOUNT" +
         counts + "\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA " + data;
}

TEST_F(ForeignMeshes, ColorsOfAPcdAreReadInEveryForm) {
  const std::vector<VertexColor> truth{{255, 0, 0}, {0, 0, 255}};
  for (const char* field : {"x y z rgb", "x y z rgba"}) {
    // With alpha 255 and without it, as PCL writes them since 1.8 and before.
    for (const char* points :
         {"1 2 3 4294901760\n4 5 6 4278190335\n", "1 2 3 16711680\n4 5 6 255\n"})
      EXPECT_EQ(read("a.pcd", pcd_of(field, "F F F U", std::string("ascii\n") + points)).colors,
                truth);
    std::string binary = "binary\n";
    for (const auto& [x, color] : {std::pair(1.0F, 0xFFFF0000U), std::pair(4.0F, 0xFF0000FFU)}) {
      for (int k = 0; k < 3; ++k)
        binary.append(reinterpret_cast<const char*>(&x), 4);
      binary.append(reinterpret_cast<const char*>(&color), 4);
    }
    EXPECT_EQ(read("a.pcd", pcd_of(field, "F F F U", binary)).colors, truth);
    EXPECT_EQ(read("a.pcd", pcd_of(field, "F F F F", binary)).colors, truth);
  }
}

TEST_F(ForeignMeshes, WholeCoordinatesOfABinaryPcdKeepTheirSign) {
  std::string binary = "binary\n";
  for (const std::int32_t number : {-1, 2, -70000, 4, -5, 6})
    binary.append(reinterpret_cast<const char*>(&number), 4);
  const Mesh mesh = read("a.pcd", pcd_of("x y z", "I I I", binary));
  ASSERT_EQ(mesh.vertices_mm.size(), 2U);
  EXPECT_EQ(mesh.vertices_mm[0], Eigen::Vector3f(-1, 2, -70000));
  EXPECT_EQ(mesh.vertices_mm[1], Eigen::Vector3f(4, -5, 6));
}

TEST_F(ForeignMeshes, PointsInATextHaveNormalsOrColors) {
  const Mesh colored = read("a.xyz", "1 2 3 255 0 10\n4 5 6 0 128 1\n");
  EXPECT_EQ(colored.colors, (std::vector<VertexColor>{{255, 0, 10}, {0, 128, 1}}));
  EXPECT_TRUE(colored.normals.empty());
  const Mesh directed = read("a.xyz", "1 2 3 0 0 1\n4 5 6 1 0 0\n");
  EXPECT_EQ(directed.normals.size(), 2U);
  EXPECT_TRUE(directed.colors.empty());
  EXPECT_TRUE(read("a.xyz", "1 2 3 0.5 7 9\n").colors.empty());
}

TEST_F(ForeignMeshes, StripsAndFansOfAGltfBecomeTriangles) {
  // A zigzag of six points in metres, y up, in base64 of 32-bit floats.
  std::string bytes;
  for (const auto& [x, y] :
       {std::pair(0.F, 0.F), {0.F, 1.F}, {1.F, 0.F}, {1.F, 1.F}, {2.F, 0.F}, {2.F, 1.F}})
    for (const float number : {x, y, 0.F})
      bytes.append(reinterpret_cast<const char*>(&number), 4);
  put("a.bin", bytes);
  const auto text = [](int mode) {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
        "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"mode": {}, "attributes": {{"POSITION": 0}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 72}}],
        "buffers": [{{"byteLength": 72, "uri": "a.bin"}}]}})",
        mode);
  };
  const Mesh strip = read("a.gltf", text(5));
  EXPECT_EQ(strip.triangles,
            (std::vector<Mesh::Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
  EXPECT_NEAR(area_of(strip), 2e6, 1.0);
  const Mesh fan = read("a.gltf", text(6));
  EXPECT_EQ(fan.triangles,
            (std::vector<Mesh::Triangle>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 5, 0}}));
}

/// A drawing whose block "Part" is a box with a corner at its base point (1, 2, 3).
std::string drawing_with_block(const std::string& entities, const std::string& more_blocks = {}) {
  const std::vector<Eigen::Vector2d> outline{{0, 0}, {30, 0}, {30, 20}, {0, 20}};
  Solid box = prism(outline, 0);
  for (Vector3d& vertex : box.vertices)
    vertex += Vector3d(1, 2, 3);
  std::string faces;
  for (const auto& face : box.faces) {
    faces += group(0, "3DFACE") + group(8, "0");
    for (int k = 0; k < 4; ++k)
      faces += point_group(k, box.vertices[face[static_cast<std::size_t>(k)]]);
  }
  const std::string blocks = group(0, "SECTION") + group(2, "BLOCKS") + group(0, "BLOCK") +
                             group(2, "Part") + point_group(0, {1, 2, 3}) + faces +
                             group(0, "ENDBLK") + more_blocks + group(0, "ENDSEC");
  return drawing(entities, blocks);
}

std::string insert_of(const std::string& block, const Vector3d& at, const std::string& more = {}) {
  return group(0, "INSERT") + group(8, "0") + group(2, block) + point_group(0, at) + more;
}

Eigen::AlignedBox3d box_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices_mm)
    box.extend(vertex.cast<double>());
  return box;
}

TEST_F(ForeignMeshes, BlocksOfADxfAreReadWhereTheyAreInserted) {
  const auto read_inserts = [&](const std::string& entities, const std::string& blocks = {}) {
    return read("a.dxf", drawing_with_block(entities, blocks));
  };
  const auto expect_box = [](const Mesh& mesh, const Vector3d& low, const Vector3d& high) {
    EXPECT_LT((box_of(mesh).min() - low).norm(), 1e-4) << box_of(mesh).min().transpose();
    EXPECT_LT((box_of(mesh).max() - high).norm(), 1e-4) << box_of(mesh).max().transpose();
  };
  Mesh mesh = read_inserts(insert_of("PART", {100, 0, 0}));
  expect_box(mesh, {100, 0, 0}, {130, 20, 10});
  EXPECT_NEAR(volume_of(mesh), 6000.0, 1e-2);
  EXPECT_EQ(said(), "");
  mesh = read_inserts(insert_of(
      "Part", {100, 0, 0}, group(41, "2") + group(42, "1") + group(43, "0.5") + group(50, "90")));
  expect_box(mesh, {80, 0, 0}, {100, 60, 5});
  mesh = read_inserts(insert_of("Part", {0, 0, 0}, group(41, "-1")));
  expect_box(mesh, {-30, 0, 0}, {0, 20, 10});
  EXPECT_NEAR(volume_of(mesh), 6000.0, 1e-2) << "mirrored, it keeps its outside";
  mesh = read_inserts(insert_of(
      "Part", {0, 0, 0}, group(70, "3") + group(71, "2") + group(44, "40") + group(45, "25")));
  expect_box(mesh, {0, 0, 0}, {110, 45, 10});
  EXPECT_EQ(mesh.triangles.size(), 72U);
  // Seen from below: x becomes -x (the arbitrary axis of -z is (-1, 0, 0)).
  mesh = read_inserts(insert_of("Part", {5, 0, 0}, group(230, "-1")));
  expect_box(mesh, {-35, 0, -10}, {-5, 20, 0});
  const std::string pair = group(0, "BLOCK") + group(2, "pair") + point_group(0, {0, 0, 0}) +
                           insert_of("Part", {0, 0, 0}) + insert_of("part", {0, 0, 10}) +
                           group(0, "ENDBLK");
  mesh = read_inserts(insert_of("pair", {0, 0, 100}, group(41, "0.5")), pair);
  expect_box(mesh, {0, 0, 100}, {15, 20, 120});
  mesh = read_inserts(insert_of("Part", {0, 0, 0}) + insert_of("nowhere", {0, 0, 0}));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_TRUE(said("left out 1 INSERT of blocks that the file does not hold")) << said();
}

TEST_F(ForeignMeshes, BlocksThatContainThemselvesOrExpandWithoutEndAreRefused) {
  const auto fault_of = [&](const std::string& entities, const std::string& blocks) {
    const auto path = put("a.dxf", drawing_with_block(entities, blocks));
    return testing::error_of([&] { return read_mesh(path); });
  };
  const auto block = [](const std::string& name, const std::string& content) {
    return group(0, "BLOCK") + group(2, name) + point_group(0, {0, 0, 0}) + content +
           group(0, "ENDBLK");
  };
  EXPECT_NE(fault_of(insert_of("a", {0, 0, 0}),
                     block("a", insert_of("b", {0, 0, 0})) + block("b", insert_of("a", {0, 0, 0})))
                .find("a block contains itself"),
            std::string::npos);
  const std::string many = group(70, "30000") + group(71, "30000");
  EXPECT_NE(
      fault_of(insert_of("a", {0, 0, 0}, many), block("a", insert_of("Part", {0, 0, 0}, many)))
          .find("of memory, more than"),
      std::string::npos);
}

constexpr const char* kCoreNamespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

void add_to(ZipWriter& zip, const std::string& name, const std::string& content) {
  zip.begin(name);
  zip.text(content);
}

std::string model_of(const std::string& attributes, const std::string& content) {
  return fmt::format(R"(<model xmlns="{}" {}>{}</model>)", kCoreNamespace, attributes, content);
}

const std::string kProduction =
    R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p")";

TEST_F(ForeignMeshes, ObjectsInFurtherFilesOfA3mfAreRead) {
  const std::string tetrahedron =
      R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/></triangles></mesh>)";
  const auto package = [&](const std::string& root) {
    ZipWriter zip(at("a.3mf"));
    add_to(zip, "3D/3dmodel.model", root);
    // In centimetres, with the same number as an object of the root.
    add_to(zip,
           "3D/Objects/one.model",
           model_of(R"(unit="centimeter")",
                    "<resources><object id=\"1\">" + tetrahedron + "</object></resources>" +
                        "<build><item objectid=\"1\"/></build>"));
    zip.commit();
    return at("a.3mf");
  };
  const auto root = [&](const std::string& path) {
    return model_of(kProduction,
                    "<resources><object id=\"1\"><components><component objectid=\"1\" p:path=\"" +
                        path +
                        "\" transform=\"1 0 0 0 1 0 0 0 1 100 0 0\"/></components></object>"
                        "</resources><build><item objectid=\"1\"/><item objectid=\"1\" p:path=\"" +
                        path + "\"/></build>");
  };
  const Mesh mesh = read_mesh(package(root("/3D/Objects/one.model")));
  EXPECT_EQ(mesh.triangles.size(), 8U) << "the build of the second file is not built";
  EXPECT_LT((box_of(mesh).min() - Vector3d(0, 0, 0)).norm(), 1e-4);
  EXPECT_LT((box_of(mesh).max() - Vector3d(110, 10, 10)).norm(), 1e-4);
  const auto missing = package(root("/3D/Objects/two.model"));
  EXPECT_NE(testing::error_of([&] { return read_mesh(missing); }).find("3D/Objects/two.model"),
            std::string::npos);
}

TEST_F(ForeignMeshes, A3mfThatRequiresAnUnknownExtensionIsRefusedByName) {
  const auto fault_of = [&](const std::string& attributes) {
    ZipWriter zip(at("a.3mf"));
    add_to(zip, "3D/3dmodel.model", model_of(attributes, "<resources/><build/>"));
    zip.commit();
    return testing::error_of([&] { return read_mesh(at("a.3mf")); });
  };
  const std::string beams = fault_of(
      R"(xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02" requiredextensions="b")");
  EXPECT_NE(beams.find("requires an extension that is not read, http://schemas.microsoft.com/"
                       "3dmanufacturing/beamlattice/2017/02"),
            std::string::npos)
      << beams;
  EXPECT_NE(fault_of(kProduction).find("no triangles"), std::string::npos);
}

}  // namespace
}  // namespace frangia
