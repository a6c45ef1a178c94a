#include "frangia/files/read_mesh.h"

#include <random>
#include <string>

#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/write_mesh.h"

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

class ReadMesh : public testing::FolderFixture {
 protected:
  [[nodiscard]] std::string error_reading(const std::string& name) const {
    return error_of([&] { return read_mesh(at(name)); });
  }
};

TEST_F(ReadMesh, IgnoresTheCaseOfTheExtension) {
  const Mesh mesh = testing::sheet(5);
  for (const char* name : {"part.stl", "part.PLY", "Part.Obj"}) {
    write_mesh(at(name), mesh);
    EXPECT_EQ(read_mesh(at(name)).triangles.size(), mesh.triangles.size()) << name;
  }
}

TEST_F(ReadMesh, ListsTheKnownExtensions) {
  EXPECT_NE(error_reading("part.step").find(".xyz or .pcd"), std::string::npos);
}

TEST_F(ReadMesh, RefusesMissingFilesAndFolders) {
  EXPECT_NE(error_reading("part.stl").find("no such file"), std::string::npos);
  std::filesystem::create_directory(at("folder.ply"));
  EXPECT_NE(error_reading("folder.ply").find("not a regular file"), std::string::npos);
}

TEST_F(ReadMesh, RefusesAVertexThatNoPartCanHave) {
  Mesh mesh = testing::sheet(5);
  mesh.vertices_mm[7].x() = 3e14F;  // far, and its squares fit into float
  write_mesh(at("far.obj"), mesh);
  EXPECT_EQ(read_mesh(at("far.obj")).vertices_mm.size(), mesh.vertices_mm.size());
  mesh.vertices_mm[7].x() = -3e37F;
  EXPECT_NE(error_of([&] { check_mesh(mesh, "far.stl"); }).find("vertex 7"), std::string::npos);
}

TEST_F(ReadMesh, ReadsADamagedFileAsAnErrorOrAConsistentMesh) {
  std::mt19937 random(1997);
  for (const char* name : {"part.stl", "part.ply", "part.obj"}) {
    write_mesh(at(name), testing::measured_sheet(4));
    const std::string whole = bytes_in(name);
    int errors = 0;
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = whole;
      for (int hit = 0; hit < 3; ++hit)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      static_cast<void>(put(name, damaged));
      try {
        check_mesh(read_mesh(at(name)), name);
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        ++errors;
      }
    }
    EXPECT_GT(errors, 0) << name;
    EXPECT_LT(errors, 300) << name;
  }
}

}  // namespace
}  // namespace frangia
