#include "frangia/files/stl.h"

#include <cstring>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

class ReadStl : public testing::FolderFixture {
 protected:
  [[nodiscard]] std::string error_reading(const std::string& bytes) const {
    const auto path = put("part.stl", bytes);
    return error_of([&] { return read_stl(path); });
  }
  [[nodiscard]] std::string binary_of(const Mesh& mesh) const {
    write_stl(at("binary.stl"), mesh);
    return bytes_in("binary.stl");
  }
};

std::string ascii_of(const Mesh& mesh) {
  std::string text = "solid facet of a diamond\n";
  for (const auto& triangle : mesh.triangles) {
    text += "  facet normal 0 0 1\n    outer loop\n";
    for (const auto corner : triangle) {
      const Eigen::Vector3f& v = mesh.vertices_mm[corner];
      text += fmt::format("      vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid facet of a diamond\n";
}

/// The corners of all triangles in order: the content of an STL.
std::vector<Eigen::Vector3f> corners_of(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const auto corner : triangle)
      corners.push_back(mesh.vertices_mm[corner]);
  }
  return corners;
}

TEST_F(ReadStl, ReadsBackWhatWriteStlWroteWithSharedVertices) {
  const Mesh mesh = testing::sheet(9);
  write_stl(at("part.stl"), mesh);
  const Mesh back = read_stl(at("part.stl"));
  EXPECT_EQ(corners_of(back), corners_of(mesh));
  EXPECT_EQ(back.vertices_mm.size(), mesh.vertices_mm.size());
}

TEST_F(ReadStl, ReadsAsciiAndBinaryAlike) {
  const Mesh mesh = testing::sheet(5);
  testing::expect_same_surface(read_stl(put("ascii.stl", ascii_of(mesh))),
                               read_stl(put("binary.stl", binary_of(mesh))));
}

TEST_F(ReadStl, RecognizesABinaryFileThatBeginsWithSolid) {
  const Mesh mesh = testing::sheet(5);
  std::string bytes = binary_of(mesh);
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(corners_of(read_stl(put("part.stl", bytes))), corners_of(mesh));
}

TEST_F(ReadStl, ReadsUpperCaseAndSeveralSolids) {
  const std::string two = "SOLID\nENDSOLID\n" + ascii_of(testing::sheet(2));
  EXPECT_EQ(read_stl(put("part.stl", two)).triangles.size(), 2U);
}

TEST_F(ReadStl, OmitsTrianglesWithTwoIdenticalCorners) {
  Mesh mesh = testing::sheet(3);
  const std::size_t whole = mesh.triangles.size();
  mesh.triangles.push_back({0, 1, 0});
  EXPECT_EQ(read_stl(put("part.stl", binary_of(mesh))).triangles.size(), whole);
}

TEST_F(ReadStl, RefusesAFileTruncatedAnywhere) {
  const Mesh mesh = testing::sheet(2);
  for (const std::string& whole : {binary_of(mesh), ascii_of(mesh)}) {
    const std::size_t least = whole.find("endsolid") == std::string::npos
                                  ? whole.size()
                                  : whole.find("endsolid") + 3;  // "end" ends a solid, too
    for (std::size_t size = 0; size < least; ++size) {
      const std::string message = error_reading(whole.substr(0, size));
      EXPECT_NE(message.find("part.stl"), std::string::npos) << "cut to " << size;
    }
  }
}

TEST_F(ReadStl, RefusesACountThatDoesNotFitTheSize) {
  std::string bytes = binary_of(testing::sheet(3));
  const std::uint32_t many = 1000;
  std::memcpy(bytes.data() + 80, &many, sizeof many);
  EXPECT_NE(error_reading(bytes).find("50084"), std::string::npos);
}

TEST_F(ReadStl, RefusesACornerThatIsNotFinite) {
  std::string bytes = binary_of(testing::sheet(3));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + 84 + 12, &nan, sizeof nan);
  EXPECT_NE(error_reading(bytes).find("vertex 0"), std::string::npos);
}

TEST_F(ReadStl, NamesTheLineOfAnUnexpectedWord) {
  std::string text = ascii_of(testing::sheet(2));
  text.replace(text.find("outer"), 5, "inner");
  EXPECT_NE(error_reading(text).find("line 3: expected 'outer', found 'inner'"), std::string::npos);
}

using WriteStl = ReadStl;

TEST_F(WriteStl, GivesEachTriangleItsOwnUnitNormal) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  const std::string bytes = binary_of(mesh);
  Eigen::Vector3f first;
  Eigen::Vector3f second;
  std::memcpy(first.data(), bytes.data() + 84, 12);
  std::memcpy(second.data(), bytes.data() + 84 + 50, 12);
  EXPECT_EQ(first, Eigen::Vector3f::UnitZ());
  EXPECT_EQ(second, Eigen::Vector3f::UnitY());
}

}  // namespace
}  // namespace frangia
