#include "frangia/files/internal/obj.h"

#include <string>

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::expect_same_surface;

class ReadObj : public testing::FolderFixture {
 protected:
  [[nodiscard]] std::string error_reading(const std::string& text) const {
    const auto path = put("part.obj", text);
    return error_of([&] { return read_obj(path); });
  }
};

const std::string kSquare =
    "mtllib part.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\ns off\n";

TEST_F(ReadObj, ReadsBackWhatWriteObjWroteExactly) {
  const Mesh mesh = testing::measured_sheet(9);
  write_obj(at("part.obj"), mesh);
  const Mesh back = read_obj(at("part.obj"));
  expect_same_surface(back, mesh);
  EXPECT_EQ(back.normals, mesh.normals);
}

TEST_F(ReadObj, ReadsPointsWithoutFaces) {
  Mesh points;
  points.vertices_mm = testing::sheet(4).vertices_mm;
  write_obj(at("points.obj"), points);
  expect_same_surface(read_obj(at("points.obj")), points);
}

TEST_F(ReadObj, ReadsEveryFormOfACorner) {
  const std::vector<Mesh::Triangle> fan{{0, 1, 2}, {0, 2, 3}};
  for (const char* face : {"f 1 2 3 4",
                           "f 1/1 2/1 3/1 4/1\r",
                           "f 1//1 2//2 3//3 4//4 # done",
                           "f 1/1/1 2/1/2 3/1/3 4/1/4",
                           "f -4 -3 -2 -1",
                           "f\t-4//-4 -3//-3 -2//-2 -1//-1"}) {
    const std::string text = std::string(face).substr(0, std::string(face).find('#'));
    const Mesh mesh = read_obj(put("part.obj", kSquare + text));
    EXPECT_EQ(mesh.triangles, fan) << face;
    const bool has_normals = std::string(face).find("//") != std::string::npos ||
                             std::string(face).find("/1/1") != std::string::npos;
    EXPECT_EQ(mesh.normals.size(), has_normals ? 4U : 0U) << face;
  }
}

TEST_F(ReadObj, ResolvesNegativeIndicesFromTheLastVertexSoFar) {
  const Mesh mesh = read_obj(put("part.obj", kSquare + "f -4 -3 -2\nv 2 2 2\nf -4 -3 -2\n"));
  EXPECT_EQ(mesh.triangles, (std::vector<Mesh::Triangle>{{0, 1, 2}, {1, 2, 3}}));
}

TEST_F(ReadObj, DropsNormalsThatBelongToCornersRatherThanVertices) {
  EXPECT_TRUE(read_obj(put("part.obj", kSquare + "f 1//1 2//1 3//1\n")).normals.empty());
}

TEST_F(ReadObj, RefusesAndNamesTheLine) {
  EXPECT_NE(error_reading("v 0 0 0\nv 1 two 3\n").find("line 2: 'two'"), std::string::npos);
  EXPECT_NE(error_reading("v 0 0 0\nv 1 2").find("line 2"), std::string::npos);
  EXPECT_NE(error_reading(kSquare + "f 1 2\n").find("line 12: a face has 2"), std::string::npos);
  EXPECT_NE(error_reading(kSquare + "f 0 1 2\n").find("'0'"), std::string::npos);
  EXPECT_NE(error_reading(kSquare + "f -5 1 2\n").find("'-5'"), std::string::npos);
  EXPECT_NE(error_reading(kSquare + "f 1 2 1.5\n").find("'1.5'"), std::string::npos);
}

TEST_F(ReadObj, RefusesAVertexIndexOutOfRange) {
  EXPECT_NE(error_reading(kSquare + "f 1 2 5\n").find("refers to vertex 4, counted from 0"),
            std::string::npos);
}

TEST_F(ReadObj, RefusesAFileWithoutVertices) {
  EXPECT_NE(error_reading("\x01\x02 solid\n").find("not an OBJ file"), std::string::npos);
}

TEST_F(ReadObj, RefusesAVertexThatIsNotFinite) {
  EXPECT_NE(error_reading("v 0 0 0\nv nan 0 0\n").find("vertex 1"), std::string::npos);
}

}  // namespace
}  // namespace frangia
