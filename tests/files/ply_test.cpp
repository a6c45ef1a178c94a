#include "frangia/files/ply.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "frangia/core/missing.h"

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::expect_same_surface;

class ReadPly : public testing::FolderFixture {
 protected:
  [[nodiscard]] std::string error_reading(const std::string& bytes) const {
    const auto path = put("part.ply", bytes);
    return error_of([&] { return read_ply(path); });
  }
};
using WritePly = ReadPly;

/// The bytes of a number in either byte order.
template <typename Number>
std::string raw(Number value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::copy_n(reinterpret_cast<const char*>(&value), sizeof value, bytes.begin());
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

const std::string kSquareHeader =
    " 1.0\ncomment a square\nelement camera 1\nproperty list uchar short settings\n"
    "element vertex 4\nproperty double x\nproperty double y\nproperty float z\n"
    "property uchar red\nproperty list uchar int links\nproperty float sigma_mm\n"
    "element face 1\nproperty uchar flags\nproperty list uchar uint vertex_index\nend_header\n";

/// A square with every kind of property and element that the reader must skip.
std::string square(bool big_endian) {
  std::string bytes =
      big_endian ? "ply\nformat binary_big_endian" : "ply\nformat binary_little_endian";
  bytes +=
      kSquareHeader + "\2" + raw<std::int16_t>(-5, big_endian) + raw<std::int16_t>(9, big_endian);
  for (int i = 0; i < 4; ++i) {
    bytes += raw<double>(i % 3 == 0 ? 0 : 1, big_endian) + raw<double>(i < 2 ? 0 : 1, big_endian);
    bytes += raw<float>(0.25F, big_endian) + "\x7f\1" + raw<std::int32_t>(i, big_endian);
    bytes += raw<float>(0.5F, big_endian);
  }
  bytes += "\7\4";
  for (std::uint32_t i = 0; i < 4; ++i)
    bytes += raw<std::uint32_t>(i, big_endian);
  return bytes;
}

const std::string kAsciiSquare = "ply\nformat ascii" + kSquareHeader +
                                 "2 -5 9\n"
                                 "0 0 0.25 127 1 0 0.5\n1 0 +.25 127 1 0 5e-1\n"
                                 "1.0 1.0 0.25 127 0 0.5\n0 1 0.25 127 2 0 0 0.5\n"
                                 "7 4 0 1 2 3";

TEST_F(ReadPly, ReadsBackWhatWritePlyWrote) {
  Mesh mesh = testing::measured_sheet(9);
  mesh.sigma_mm[3] = kMissing;
  write_ply(at("part.ply"), mesh);
  const Mesh back = read_ply(at("part.ply"));
  expect_same_surface(back, mesh);
  EXPECT_EQ(back.normals, mesh.normals);
  EXPECT_EQ(back.views, mesh.views);
  ASSERT_EQ(back.sigma_mm.size(), mesh.sigma_mm.size());
  for (std::size_t i = 0; i < mesh.sigma_mm.size(); ++i)
    EXPECT_TRUE(back.sigma_mm[i] == mesh.sigma_mm[i] || (i == 3 && std::isnan(back.sigma_mm[i])));
}

TEST_F(ReadPly, ReadsPointsWithoutFaces) {
  Mesh points;
  points.vertices_mm = testing::sheet(4).vertices_mm;
  write_ply(at("points.ply"), points);
  expect_same_surface(read_ply(at("points.ply")), points);
}

TEST_F(ReadPly, ReadsAsciiAndBothByteOrdersAlike) {
  Mesh expected;
  expected.vertices_mm = {{0, 0, 0.25F}, {1, 0, 0.25F}, {1, 1, 0.25F}, {0, 1, 0.25F}};
  expected.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const std::string& bytes : {square(false), square(true), kAsciiSquare}) {
    const Mesh mesh = read_ply(put("square.ply", bytes));
    expect_same_surface(mesh, expected);
    EXPECT_EQ(mesh.sigma_mm, std::vector<float>(4, 0.5F));
    EXPECT_TRUE(mesh.normals.empty());
  }
}

TEST_F(ReadPly, AcceptsBothKindsOfLineEnds) {
  std::string windows;
  for (const char c : kAsciiSquare)
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_same_surface(read_ply(put("windows.ply", windows)),
                      read_ply(put("unix.ply", kAsciiSquare)));
}

TEST_F(ReadPly, SetsNormalsThatAreNotFiniteToZero) {
  const Mesh mesh = read_ply(put("part.ply",
                                 "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                                 "property float y\nproperty float z\nproperty float nx\n"
                                 "property float ny\nproperty float nz\nend_header\n"
                                 "1 2 3 nan nan nan\n4 5 6 0 1 0\n"));
  EXPECT_EQ(mesh.normals, (std::vector<Eigen::Vector3f>{{0, 0, 0}, {0, 1, 0}}));
}

TEST_F(ReadPly, RefusesAFileTruncatedAnywhere) {
  for (const std::string& whole : {square(false), square(true), kAsciiSquare}) {
    for (std::size_t size = 0; size < whole.size(); size += 3) {
      const std::string message = error_reading(whole.substr(0, size));
      EXPECT_NE(message.find("part.ply"), std::string::npos) << "cut to " << size;
    }
  }
}

TEST_F(ReadPly, RefusesATooLargeCountBeforeItAllocates) {
  for (const std::string& whole : {square(false), kAsciiSquare}) {
    std::string lying = whole;
    lying.replace(lying.find("vertex 4"), 8, "vertex 9000000000000000000");
    EXPECT_NE(error_reading(lying).find("states 9000000000000000000 of 'vertex'"),
              std::string::npos);
  }
}

TEST_F(ReadPly, NamesTheLineOfAnErrorInTheHeader) {
  EXPECT_NE(error_reading("ply\nformat ascii 1.0\nelement vertex four\n").find("line 3"),
            std::string::npos);
  EXPECT_NE(error_reading("ply\nformat octal 1.0\n").find("'octal'"), std::string::npos);
}

std::string ascii_triangle(const std::string& first_vertex, const std::string& face) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list char int vertex_indices\nend_header\n" +
         first_vertex + "\n1 0 0\n0 1 0\n" + face + "\n";
}

TEST_F(ReadPly, RefusesInvalidMeshes) {
  EXPECT_NE(error_reading(ascii_triangle("0 0 0", "3 0 1 3")).find("refers to vertex 3"),
            std::string::npos);
  EXPECT_NE(error_reading(ascii_triangle("0 0 0", "3 0 1 -1")).find("refers to vertex -1"),
            std::string::npos);
  EXPECT_NE(error_reading(ascii_triangle("0 0 0", "2 0 1")).find("2 corners"), std::string::npos);
  EXPECT_NE(error_reading(ascii_triangle("0 0 0", "-3 0 1 2")).find("-3 values"),
            std::string::npos);
  EXPECT_NE(error_reading(ascii_triangle("0 nan 0", "3 0 1 2")).find("vertex 0"),
            std::string::npos);
  EXPECT_NE(error_reading(ascii_triangle("0 1e39 0", "3 0 1 2")).find("inf"), std::string::npos);
  EXPECT_NE(error_reading(ascii_triangle("0 zero 0", "3 0 1 2")).find("'zero'"), std::string::npos);
}

TEST_F(ReadPly, RefusesTriangleStrips) {
  EXPECT_NE(error_reading("ply\nformat ascii 1.0\nelement tristrips 1\n"
                          "property list int int vertex_indices\nend_header\n4 0 1 2 3\n")
                .find("strips"),
            std::string::npos);
}

TEST_F(WritePly, RefusesAWrongNumberOfNormals) {
  Mesh mesh = testing::measured_sheet(3);
  mesh.normals.pop_back();
  EXPECT_NE(error_of([&] { return write_ply(at("part.ply"), mesh), 0; }).find("8 normals"),
            std::string::npos);
  EXPECT_TRUE(folder_is_empty());
}

}  // namespace
}  // namespace frangia
