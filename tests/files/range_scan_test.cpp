#include "frangia/files/range_scan.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/files/read_mesh.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

/// A grid of 3 x 3 points without the one in the middle of the first row.
std::string small_grid(int columns) {
  std::string text = "ply\nformat ascii 1.0\nobj_info num_cols " + std::to_string(columns) +
                     "\nobj_info num_rows 3\nelement vertex 8\nproperty float x\n"
                     "property float y\nproperty float z\nelement range_grid 9\n"
                     "property list uchar int vertex_indices\nend_header\n";
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      if (y == 0 && x == 1) continue;
      text += std::to_string(x) + " " + std::to_string(y) + " 0\n";
    }
  }
  return text + "1 0\n0\n1 1\n1 2\n1 3\n1 4\n1 5\n1 6\n1 7\n";
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST(RangeScan, ConnectsNeighboursOfAGridWithTrianglesThatFaceUp) {
  const TemporaryFolder folder;
  write(folder.path() / "grid.ply", small_grid(3));
  const Mesh mesh = read_range_scan(folder.path() / "grid.ply").mesh;
  EXPECT_EQ(mesh.vertices_mm.size(), 8U);
  ASSERT_EQ(mesh.triangles.size(), 6U);  // eight minus the two at the missing point
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f normal = (mesh.vertices_mm[b] - mesh.vertices_mm[a])
                                       .cross(mesh.vertices_mm[c] - mesh.vertices_mm[a]);
    EXPECT_GT(normal.z(), 0.0F);
  }
}

TEST(RangeScan, ReadsVerticesThatAreNotWholeAndRemarksInTheHeader) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "grid.ply")
      << "ply\nformat ascii 1.0\ncomment scanned by\nhand, twice\n\nobj_info num_cols 2\n"
         "obj_info num_rows 2\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\n\nelement range_grid 4\nproperty list uchar int vertex_indices\n"
         "end_header\n0.25 0 0.5\n1.25 0 0.5\n0.25 1 0.5\n1.25 1 1e10\n1 0\n1 1\n1 2\n0\n";
  const Mesh mesh = read_range_scan(folder.path() / "grid.ply").mesh;
  EXPECT_EQ(mesh.vertices_mm.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 1U);
}

TEST(RangeScan, IsAMeshForEveryVerbAndOfAnyFormat) {
  const TemporaryFolder folder;
  write(folder.path() / "grid.ply", small_grid(3));
  EXPECT_EQ(read_mesh(folder.path() / "grid.ply").triangles.size(), 6U);
  write(folder.path() / "points.xyz", "0 0 1\n1 0 1\n0 1 1\n");
  EXPECT_EQ(read_range_scan(folder.path() / "points.xyz").mesh.vertices_mm.size(), 3U);
}

TEST(RangeScan, RefusesAGridThatDoesNotMatchItsStatedSize) {
  const TemporaryFolder folder;
  write(folder.path() / "grid.ply", small_grid(4));
  EXPECT_THROW(static_cast<void>(read_range_scan(folder.path() / "grid.ply")), Error);
}

TEST(RangeScan, RotatesByTheConjugateOfTheQuaternionInAConf) {
  const TemporaryFolder folder;
  write(folder.path() / "grid.ply", small_grid(3));
  write(folder.path() / "all.conf",
        "camera 0 0 0 0 0 0 1\nbmesh grid.ply 1 2 3 0 0 0.70710678 0.70710678\n");
  const auto scans = read_posed_scans(folder.path() / "all.conf");
  ASSERT_EQ(scans.size(), 1U);
  const Eigen::Vector3d turned = scans[0].world_from_scan * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(turned.isApprox(Eigen::Vector3d(1.0, 1.0, 3.0), 1e-6)) << turned.transpose();
}

TEST(RangeScan, WritesAConfThatReadsBack) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  write(folder.path() / "grid.ply", small_grid(3));
  write(folder.path() / "all.conf", "bmesh grid.ply 1 2 3 0.1 0.2 0.3 0.9\n");
  auto scans = read_posed_scans(folder.path() / "all.conf");
  const Eigen::Isometry3d pose = scans[0].world_from_scan;
  scale_range_scan(scans[0], 1000.0);  // from metres
  EXPECT_NEAR(scans[0].world_from_scan.translation().z(), 3000.0, 1e-9);
  write_posed_scans(folder.path() / "sub" / "new.conf", scans, 0.001);
  const auto again = read_posed_scans(folder.path() / "sub" / "new.conf");
  ASSERT_EQ(again.size(), 1U);
  EXPECT_TRUE(again[0].world_from_scan.isApprox(pose, 1e-8));
  EXPECT_EQ(again[0].mesh.vertices_mm.size(), scans[0].mesh.vertices_mm.size());
}

void read_text(const std::string& text) {
  const TemporaryFolder folder;
  write(folder.path() / "grid.ply", text);
  static_cast<void>(read_range_scan(folder.path() / "grid.ply"));
}

/// The message about a file with this text.
std::string fault_of(const std::string& text) {
  return testing::error_of([&] {
    read_text(text);
    return 0;
  });
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(RangeScan, RefusesSizesWhoseProductOverflows) {
  std::string text = with(small_grid(3), "num_cols 3", "num_cols 9223372036854775807");
  text = with(text, "num_rows 3", "num_rows 9223372036854775799");  // their product is 9 in 64 bits
  EXPECT_NE(fault_of(text).find("its range_grid has 9 cells"), std::string::npos);
  EXPECT_NE(fault_of(with(small_grid(3), "num_cols 3", "num_cols -3")).find("9 cells"),
            std::string::npos);
}

TEST(RangeScan, SkipsAnElementWithoutPropertiesWhateverItsCount) {
  const std::string other = with(
      small_grid(3), "element range_grid", "element other 9000000000000000000\nelement range_grid");
  EXPECT_NO_THROW(read_text(other));
  const std::string grid =
      "ply\nformat ascii 1.0\nobj_info num_cols 3\nobj_info num_rows 3\n"
      "element vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement range_grid 9000000000000000000\n"
      "end_header\n0 0 0\n";
  EXPECT_LT(grid.size(), 203U);
  EXPECT_NE(fault_of(grid).find("its range_grid has 0 cells"), std::string::npos);
}

TEST(RangeScan, RefusesIndicesAndLengthsThatAreNoWholeNumbers) {
  const std::string real = with(small_grid(3), "list uchar int", "list uchar double");
  EXPECT_NO_THROW(read_text(real));
  for (const char* wrong : {"1 1e300\n", "1 nan\n", "1 inf\n", "1 0.5\n", "1 5e9\n"})
    EXPECT_NE(fault_of(with(real, "1 7\n", wrong)).find("not a valid index"), std::string::npos)
        << wrong;
  const std::string length = with(small_grid(3), "list uchar int", "list double int");
  for (const char* wrong : {"1e300 7\n", "nan 7\n", "inf 7\n", "-1 7\n", "0.5 7\n"})
    EXPECT_NE(fault_of(with(length, "1 7\n", wrong)).find("states"), std::string::npos) << wrong;
}

TEST(RangeScan, RefusesAPoseThatIsNotFinite) {
  const TemporaryFolder folder;
  write(folder.path() / "grid.ply", small_grid(3));
  write(folder.path() / "all.conf", "bmesh grid.ply 0 0 0 1e200 1e200 0 1e200\n");
  EXPECT_THROW(static_cast<void>(read_posed_scans(folder.path() / "all.conf")), Error);
}

TEST(RangeScan, NamesTheInvalidLineOfAConf) {
  const TemporaryFolder folder;
  write(folder.path() / "all.conf", "\nbmesh grid.ply 1 2\n");
  try {
    static_cast<void>(read_posed_scans(folder.path() / "all.conf"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace frangia
