#include "frangia/files/dxf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "files/external_readers.h"
#include "files/folder_fixture.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::ReaderAnswer;

constexpr std::array kVariants{DxfVariant::Faces, DxfVariant::Polyface};

class WriteDxf : public testing::FolderFixture {
 protected:
  std::filesystem::path write(const Mesh& mesh, DxfVariant variant) const {
    write_dxf(at("part.dxf"), mesh, {variant});
    return at("part.dxf");
  }
  [[nodiscard]] std::string error_writing(const Mesh& mesh) const {
    return error_of([&] { return write(mesh, DxfVariant::Faces); });
  }
};

/// A checker prints the number of faces, then the low and high corners of one or two bounding
/// boxes.
void expect_complete(const ReaderAnswer& answer, const Mesh& mesh) {
  ASSERT_TRUE(answer.succeeded) << answer.text;
  std::istringstream words(answer.text);
  std::size_t faces = 0;
  words >> faces;
  EXPECT_EQ(faces, mesh.triangles.size());
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const auto& vertex : mesh.vertices_mm) {
    const Eigen::Vector3d written = (vertex.cast<double>() * 1e4).array().round() / 1e4;
    low = low.cwiseMin(written);
    high = high.cwiseMax(written);
  }
  std::size_t boxes = 0;
  for (Eigen::Vector3d a, b; words >> a.x() >> a.y() >> a.z() >> b.x() >> b.y() >> b.z(); ++boxes) {
    EXPECT_LT((a - low).norm() + (b - high).norm(), 1e-9) << answer.text;
  }
  EXPECT_GE(boxes, 1U) << answer.text;
}

TEST_F(WriteDxf, PassesTheAuditOfEzdxfWithAllFacesAndExactExtents) {
  if (!testing::have_ezdxf()) GTEST_SKIP() << "python3-ezdxf is missing; ./run setup installs it";
  const Mesh mesh = testing::marked_sheet(30);
  for (const DxfVariant variant : {DxfVariant::Faces, DxfVariant::Polyface, DxfVariant::Mesh})
    expect_complete(testing::ask_ezdxf(write(mesh, variant)), mesh);
}

TEST_F(WriteDxf, IsReadByLibdimeWithAllFacesEvenBeyond16BitIndices) {
  if (std::string(FRANGIA_CHECK_LIBDIME).empty()) {
    GTEST_SKIP() << "libdime-dev is missing; ./run setup installs it, then configure again";
  }
  const Mesh mesh = testing::marked_sheet(200);  // 40 000 vertices, 79 202 triangles
  for (const DxfVariant variant : kVariants)
    expect_complete(testing::ask_libdime(write(mesh, variant)), mesh);
}

TEST_F(WriteDxf, RoundsCoordinatesToATenThousandthWithoutTrailingZeros) {
  Mesh mesh;
  mesh.vertices_mm = {{0.00004F, -0.00016F, 12.5F}, {-1.0F, 0.0F, 1234.5F}, {0.1F, 10.01F, 0.0F}};
  mesh.triangles = {{0, 1, 2}};
  const auto path = write(mesh, DxfVariant::Faces);
  const std::string text = bytes_in("part.dxf");
  EXPECT_NE(text.find("  0\n3DFACE\n  8\nSCAN\n"
                      " 10\n0.0\n 20\n-0.0002\n 30\n12.5\n"
                      " 11\n-1.0\n 21\n0.0\n 31\n1234.5\n"
                      " 12\n0.1\n 22\n10.01\n 32\n0.0\n"
                      " 13\n0.1\n 23\n10.01\n 33\n0.0\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("$EXTMIN\n 10\n-1.0\n 20\n-0.0002\n 30\n0.0\n"), std::string::npos);
  EXPECT_NE(text.find("$EXTMAX\n 10\n0.1\n 20\n10.01\n 30\n1234.5\n"), std::string::npos);
}

TEST_F(WriteDxf, OmitsTrianglesThatRoundToNothing) {
  Mesh mesh = testing::sheet(4);
  const auto plain = write(mesh, DxfVariant::Faces);
  const std::string expected = bytes_in("part.dxf");
  mesh.vertices_mm.emplace_back(500.0F, 500.0F, 500.0F);
  mesh.vertices_mm.emplace_back(
      500.00001F, 500.0F, 500.0F);  // differs only below the resolution of the file
  mesh.triangles.push_back({3, 3, 4});
  mesh.triangles.push_back({3, 16, 17});
  const auto more = write(mesh, DxfVariant::Faces);
  EXPECT_EQ(bytes_in("part.dxf"), expected);
}

TEST_F(WriteDxf, RefusesAMeshWithoutAFaceAboveTheResolution) {
  Mesh mesh = testing::sheet(3);
  for (auto& vertex : mesh.vertices_mm)
    vertex *= 1e-6F;
  EXPECT_NE(error_writing(mesh).find("0.0001 mm"), std::string::npos);
  mesh.triangles.clear();
  EXPECT_NE(error_writing(mesh).find("no triangle"), std::string::npos);
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(WriteDxf, RefusesAVertexBeyondAThousandKilometres) {
  Mesh mesh = testing::sheet(3);
  mesh.vertices_mm[4].x() = 2e9F;
  EXPECT_NE(error_writing(mesh).find("1 000 km"), std::string::npos);
  EXPECT_TRUE(folder_is_empty());
}

/// Expects the same number of vertices, of triangles and of triangles of each mark, and the same
/// centroid of the vertices.
void expect_alike(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(a.vertices_mm.size(), b.vertices_mm.size());
  const auto marks = [](const Mesh& mesh) {
    std::array<std::size_t, 3> counts{};
    for (const Mark mark : mesh.triangle_marks)
      ++counts.at(static_cast<std::size_t>(mark));
    return counts;
  };
  EXPECT_EQ(marks(a), marks(b));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& v : a.vertices_mm)
    sum += v.cast<double>();
  for (const auto& v : b.vertices_mm)
    sum -= v.cast<double>();
  EXPECT_LT(sum.norm(), 1e-4 * static_cast<double>(a.vertices_mm.size()));
}

using ReadDxf = WriteDxf;

TEST_F(ReadDxf, ReadsEveryVariantBackWithItsMarks) {
  const Mesh mesh = testing::marked_sheet(200);  // several polyfaces
  for (const DxfVariant variant : {DxfVariant::Faces, DxfVariant::Polyface, DxfVariant::Mesh})
    expect_alike(read_dxf(write(mesh, variant)), mesh);
}

TEST_F(ReadDxf, ReadsWhatEzdxfWritesAndListsWhatItSkips) {
  if (!testing::have_ezdxf()) GTEST_SKIP() << "python3-ezdxf is missing; ./run setup installs it";
  static_cast<void>(put("make.py",
                        "import sys, ezdxf\n"
                        "d = ezdxf.new('R2010', units=1)\n"  // inches
                        "m = d.modelspace()\n"
                        "m.add_3dface([(0,0,0),(1,0,0),(1,1,0),(0,1,0)])\n"
                        "m.add_line((0,0),(1,1))\nm.add_line((0,0),(2,1))\nm.add_circle((0,0),1)\n"
                        "m.add_text('mesh')\nm.add_lwpolyline([(0,0),(1,0)])\n"
                        "g = m.add_polymesh((3, 2))\n"
                        "for i in range(3):\n"
                        "  for j in range(2): g.set_mesh_vertex((i, j), (i, j, 5))\n"
                        "p = m.add_polyface()\np.append_face([(0,0,9),(1,0,9),(0,1,9)])\n"
                        "with m.add_mesh().edit_data() as e:\n"
                        "  e.vertices=[(0,0,7),(1,0,7),(1,1,7),(0,1,7)]; e.faces=[(0,1,2,3)]\n"
                        "d.saveas(sys.argv[1])\n"));
  const auto path = at("other.dxf");
  const ReaderAnswer made =
      testing::ask("/usr/bin/python3 " + at("make.py").string() + " " + path.string());
  ASSERT_TRUE(made.succeeded) << made.text;
  frangia::Run run;
  std::string warning;
  run.on_warning = [&](const std::string& sentence) { warning = sentence; };
  const Mesh mesh = read_dxf(path, run);
  EXPECT_EQ(mesh.triangles.size(), 2U + 4U + 1U + 2U);
  float farthest = 0.0F;
  for (const auto& vertex : mesh.vertices_mm)
    farthest = std::max(farthest, vertex.z());
  EXPECT_FLOAT_EQ(farthest, 9 * 25.4F);
  EXPECT_NE(warning.find("1 CIRCLE, 2 LINE, 1 LWPOLYLINE, 1 TEXT"), std::string::npos) << warning;
}

TEST_F(ReadDxf, ListsTheEntitiesOfAFileWithoutAMesh) {
  const auto path = put("line.dxf", "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n1\n0\nENDSEC\n0\nEOF\n");
  EXPECT_NE(error_of([&] { return read_dxf(path); }).find("only 1 LINE"), std::string::npos);
}

TEST_F(ReadDxf, NamesTheLineOfAnError) {
  const std::string start = "0\nSECTION\n2\nENTITIES\n";
  const auto error = [&](const std::string& rest) {
    const auto path = put("bad.dxf", start + rest);
    return error_of([&] { return read_dxf(path); });
  };
  EXPECT_NE(error("0\n3DFACE\n10\nx\n").find("line 8: 'x' is not a number"), std::string::npos);
  EXPECT_NE(error("0\n3DFACE\n10\nnan\n0\nEOF\n").find("not finite"), std::string::npos);
  EXPECT_NE(error("0\n3DFACE\n10").find("truncated"), std::string::npos);
  EXPECT_NE(error("hello\n").find("code of a group"), std::string::npos);
  EXPECT_NE(
      error("0\nPOLYLINE\n70\n64\n0\nVERTEX\n70\n192\n10\n1\n0\nVERTEX\n70\n128\n71\n1\n72\n2\n"
            "73\n-9223372036854775808\n0\nSEQEND\n")
          .find("of only 1"),
      std::string::npos);
  EXPECT_NE(error("0\nPOLYLINE\n70\n16\n71\n3\n72\n900\n0\nSEQEND\n").find("3 x 900"),
            std::string::npos);
  EXPECT_NE(error("0\nMESH\n92\n1\n10\n0\n93\n4\n90\n3\n90\n0\n90\n0\n90\n7\n0\nENDSEC\n")
                .find("vertex 7"),
            std::string::npos);
  const std::string face = "0\n3DFACE\n10\n0\n11\n1\n12\n0\n22\n1\n13\n0\n23\n1\n";
  EXPECT_NE(error(face + "0\n").find("truncated"), std::string::npos);
  EXPECT_NE(error(face).find("after 1 triangle"), std::string::npos);
  const auto binary = put("binary.dxf", std::string("AutoCAD Binary DXF\r\n\x1a\0", 22));
  EXPECT_NE(error_of([&] { return read_dxf(binary); }).find("save it as text"), std::string::npos);
}

}  // namespace
}  // namespace frangia
