#include "frangia/files/write_mesh.h"

#include <limits>
#include <string>

#include "files/external_readers.h"
#include "files/folder_fixture.h"
#include "files/sample_meshes.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

class WriteMesh : public testing::FolderFixture {
 protected:
  static constexpr std::array kNames{"part.dxf",
                                     "part.stl",
                                     "part.ply",
                                     "part.obj",
                                     "part.glb",
                                     "part.gltf",
                                     "part.3mf",
                                     "part.off"};
  [[nodiscard]] std::string error_writing(const std::string& name, const Mesh& mesh) const {
    return error_of([&] { return write_mesh(at(name), mesh), 0; });
  }
};

TEST_F(WriteMesh, IsReadByAssimpWithAllFacesWhenOpenAndMarked) {
  if (!testing::have_assimp()) GTEST_SKIP() << "assimp is missing; ./run setup installs it";
  const Mesh mesh = testing::marked_sheet(30);
  const int faces = 2 * 29 * 29;
  for (const char* name : kNames) {
    write_mesh(at(name), mesh);
    EXPECT_EQ(testing::assimp_faces(at(name)), faces) << name;
  }
  write_mesh(at("text.stl"), mesh, {.stl = {.ascii = true}});
  EXPECT_EQ(testing::assimp_faces(at("text.stl")), faces);
  write_mesh(at("polyface.dxf"), mesh, {.dxf = {DxfVariant::Polyface}});
  EXPECT_EQ(testing::assimp_faces(at("polyface.dxf")), faces);
}

TEST_F(WriteMesh, IgnoresTheCaseOfTheExtension) {
  write_mesh(at("PART.STL"), testing::sheet(3));
  EXPECT_EQ(bytes_in("PART.STL").size(), 84U + 8 * 50);
}

TEST_F(WriteMesh, ListsTheKnownExtensions) {
  for (const char* name : {"part.step", "part", ".ply", "part.zip"}) {
    EXPECT_NE(error_writing(name, testing::sheet(3)).find(".off, .xyz or .pcd"), std::string::npos);
    EXPECT_THROW(check_mesh_extension(name), Error);
  }
  EXPECT_NO_THROW(check_mesh_extension("part.Dxf"));
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(WriteMesh, LeavesNoFileOfAnInconsistentMesh) {
  Mesh not_finite = testing::sheet(3);
  not_finite.vertices_mm[7].y() = std::numeric_limits<float>::quiet_NaN();
  Mesh out_of_range = testing::sheet(3);
  out_of_range.triangles[5][2] = 9;
  for (const char* name : kNames) {
    EXPECT_NE(error_writing(name, not_finite).find("vertex 7"), std::string::npos) << name;
    EXPECT_NE(error_writing(name, out_of_range).find("triangle 5 refers to vertex 9"),
              std::string::npos)
        << name;
  }
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(WriteMesh, KeepsTheOldFileWhenTheNewOneFails) {
  Mesh bad = testing::sheet(3);
  bad.triangles[0][0] = 99;
  for (const char* name : kNames) {
    static_cast<void>(put(name, "old"));
    static_cast<void>(error_writing(name, bad));
    EXPECT_EQ(bytes_in(name), "old");
  }
}

TEST_F(WriteMesh, WarnsOfAnOpenMeshIn3mfOnly) {
  frangia::Run run;
  std::string warning;
  run.on_warning = [&](const std::string& sentence) { warning = sentence; };
  for (const char* name : kNames) {
    warning.clear();
    write_mesh(at(name), testing::sheet(3), {}, run);
    const std::string sentence =
        at("part.3mf").string() + ": the mesh has 8 open or non-manifold edges";
    EXPECT_EQ(warning.substr(0, sentence.size()), std::string(name) == "part.3mf" ? sentence : "");
  }
  warning.clear();
  write_mesh(at("part.3mf"), testing::box({0, 0, 0}, {1, 1, 1}), {}, run);
  EXPECT_EQ(warning, "");
}

TEST_F(WriteMesh, RefusesPointsInFormatsOfTrianglesOnly) {
  Mesh points;
  points.vertices_mm = testing::sheet(3).vertices_mm;
  EXPECT_NE(error_writing("part.dxf", points).find("no triangle"), std::string::npos);
  for (const char* name : {"part.stl", "part.glb", "part.gltf", "part.3mf", "part.off"})
    EXPECT_NE(error_writing(name, points).find("no triangle"), std::string::npos) << name;
  EXPECT_NO_THROW(write_mesh(at("part.xyz"), points));
  EXPECT_NO_THROW(write_mesh(at("part.pcd"), points));
  EXPECT_NO_THROW(write_mesh(at("part.ply"), points));
}

TEST_F(WriteMesh, NamesAFolderThatDoesNotExist) {
  EXPECT_NE(error_writing("nowhere/part.ply", testing::sheet(3)).find("nowhere"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
