#include "frangia/files/range_scan.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

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
