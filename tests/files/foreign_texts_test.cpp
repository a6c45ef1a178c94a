// Texts and bytes of other programs: OBJ, STL, points and strips of triangles.
#include <algorithm>
#include <cstdint>
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
using testing::ForeignMeshes;
using testing::kU;
using testing::obj_of;
using testing::prism;

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

TEST_F(ForeignMeshes, ColorsOfVerticesInOffAreWholeNumbersOrShares) {
  const std::vector<VertexColor> wanted{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
  EXPECT_EQ(read("a.off",
                 "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n")
                .colors,
            wanted);
  EXPECT_EQ(
      read("a.off", "COFF 3 1 0\n0 0 0 1.0 0 0 1\n1 0 0 0 1. 0\n0 1 0 0 0 1e0\n3 0 1 2\n").colors,
      wanted);
  EXPECT_TRUE(read("a.off", "COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").colors.empty());
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
    EXPECT_TRUE(said("left out behind its last facet")) << said();
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
  static_cast<void>(put("a.bin", bytes));
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

}  // namespace
}  // namespace frangia
