// What the program says of scans that cannot be put together: one clear sentence each.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/files/ply.h"

#include "scan/small_scan.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::TemporaryFolder;

class Together : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return "'" + (folder_.path() / name).string() + "'";
  }
  /// A height over a grid of points with triangles, that faces +z.
  void write_relief(const std::string& name,
                    const std::function<double(double, double)>& height_mm) const {
    constexpr std::uint32_t kSide = 60;
    Mesh mesh;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const double x = i % kSide;
      const double y = i / kSide;  // NOLINT(bugprone-integer-division): the row
      mesh.vertices_mm.emplace_back(
          Eigen::Vector3d(x, y, height_mm(x - kSide / 2, y - kSide / 2)).cast<float>());
      if (i % kSide == kSide - 1 || i / kSide == kSide - 1) continue;
      mesh.triangles.push_back({i, i + 1, i + kSide + 1});
      mesh.triangles.push_back({i, i + kSide + 1, i + kSide});
    }
    write_ply(folder_.path() / name, mesh);
  }
  void write_scan_of(const std::string& part, int views) const {
    static_cast<void>(testing::small_scan(folder_.path() / "scan", part, "digital", views, {}));
  }
  static void expect_told(const Answer& answer, int exit_code, const std::string& what) {
    EXPECT_EQ(answer.exit_code, exit_code) << answer.output;
    EXPECT_NE(answer.output.find(what), std::string::npos) << answer.output;
  }

 private:
  TemporaryFolder folder_;
};

double dome(double x, double y) {
  return std::sqrt(std::max(0.0, 900.0 - x * x - y * y));
}

TEST_F(Together, OneScanAloneIsPastedAsItIs) {
  write_relief("one.ply", dome);
  expect_told(
      run_program("paste " + path("one.ply") + " -o " + path("a.ply")), 0, "one scan alone");
}

TEST_F(Together, ScansThatNothingPlacesAreRefusedInOneSentence) {
  write_relief("one.ply", dome);  // a ball turns on a ball
  write_relief("two.ply", dome);
  const Answer answer = run_program("--quiet paste " + path("one.ply") + " " + path("two.ply") +
                                    " --poses shape -o " + path("a.ply"));
  expect_told(answer, 3, "look alike from several sides");
  EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1) << answer.output;
}

TEST_F(Together, PasteWritesEveryFileKindAndCapsADxf) {
  write_relief("one.ply", dome);
  const Answer answer =
      run_program("paste " + path("one.ply") + " --dxf mesh --dxf-faces 500 --stl-text -o " +
                  path("a.dxf") + " -o " + path("a.stl") + " -o " + path("a.glb"));
  expect_told(answer, 0, "are kept, which lie nowhere farther than");
}

TEST_F(Together, AVoxelThatNeedsTooMuchMemoryIsRefusedWithOneThatFits) {
  write_relief("one.ply", dome);
  expect_told(
      run_program("paste " + path("one.ply") + " --voxel 0.0001 -o " + path("a.ply")), 3, "mm fit");
}

TEST_F(Together, AViewAloneKeepsTheRigAndSaysSo) {
  write_scan_of("blade", 1);
  expect_told(run_program("reconstruct " + path("scan") + " -o " + path("a.ply")),
              0,
              "one view alone cannot be registered");
  expect_told(run_program("reconstruct " + path("scan") + " --clip-below 1000 -o " + path("b.ply")),
              3,
              "nothing is left of the object");
  expect_told(run_program("reconstruct " + path("scan") + " --voxel 0.0001 -o " + path("b.ply")),
              3,
              "mm fit");
}

TEST_F(Together, ScansThatDoNotOverlapKeepTheirPosesAndTheProgramSaysSo) {
  write_relief("one.ply", dome);
  write_relief("two.ply", [](double x, double y) { return 500.0 + dome(x, y); });
  expect_told(run_program("paste " + path("one.ply") + " " + path("two.ply") +
                          " --poses given -o " + path("a.ply")),
              0,
              "the scans do not overlap where they are said to be");
}

}  // namespace
}  // namespace frangia
