// Messages of the program about scans that cannot be registered: one clear sentence each.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <regex>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/files/ply.h"

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::TemporaryFolder;

class RegistrationProgram : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return "'" + (folder_.path() / name).string() + "'";
  }
  /// A height over a grid of points with triangles, that faces +z.
  void write_relief(const std::string& name,
                    const std::function<double(double, double)>& height_mm) const {
    constexpr std::uint32_t kSide = 60;
    constexpr double kMiddle = 30.0;
    Mesh mesh;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const double x = i % kSide;
      const double y = i / kSide;  // NOLINT(bugprone-integer-division): the row
      mesh.vertices_mm.emplace_back(
          Eigen::Vector3d(x, y, height_mm(x - kMiddle, y - kMiddle)).cast<float>());
      if (i % kSide == kSide - 1 || i / kSide == kSide - 1) continue;
      mesh.triangles.push_back({i, i + 1, i + kSide + 1});
      mesh.triangles.push_back({i, i + kSide + 1, i + kSide});
    }
    write_ply(folder_.path() / name, mesh);
  }
  void write_scan_of(const std::string& part, int views, int divisor = 4) const {
    static_cast<void>(
        testing::small_scan(folder_.path() / "scan", part, "digital", views, {}, divisor));
  }
  /// A scan of a bracket in which one view was taken after a push.
  void write_pushed_scan(std::size_t pushed_view) const {
    const Scan scan = testing::small_scan(folder_.path() / "scan", "bracket", "digital", 6, {});
    Mesh part = make_part("bracket");
    for (auto& vertex : part.vertices_mm)
      vertex += Eigen::Vector3f(0.8F, 0.6F, 0.0F);
    Scan plan = scan;
    plan.folder = folder_.path() / "pushed";
    plan.views = {scan.views[pushed_view]};
    static_cast<void>(simulate_scan(part, plan, {}));
    const auto view = scan.views[pushed_view].folder;
    std::filesystem::remove_all(scan.folder / view);
    std::filesystem::rename(plan.folder / view, scan.folder / view);
  }
  /// Expects an exit code, one sentence, and no new file under any name.
  void expect_refused(const std::string& arguments, int exit_code, const std::string& what) const {
    const auto count = [&] {
      return std::distance(std::filesystem::directory_iterator(folder_.path()), {});
    };
    const auto before = count();
    const Answer answer = run_program("--quiet " + arguments + " -o " + path("refused.ply"));
    expect_told(answer, exit_code, what);
    const std::string last = answer.output.substr(answer.output.rfind("frangia: "));
    EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << answer.output;
    EXPECT_EQ(count(), before) << answer.output;
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

TEST_F(RegistrationProgram, OneScanAloneIsMergedAsItIs) {
  write_relief("one.ply", dome);
  expect_told(run_program("merge " + path("one.ply") + " -o " + path("a.ply")),
              0,
              "a single scan is not registered");
}

TEST_F(RegistrationProgram, ScansWithoutAUniquePoseAreRefusedInOneSentence) {
  write_relief("one.ply", dome);  // a ball turns on a ball
  write_relief("two.ply", dome);
  expect_refused("merge " + path("one.ply") + " " + path("two.ply") + " --poses shape",
                 3,
                 "look alike from several sides");
}

TEST_F(RegistrationProgram, MergeWritesEveryFileKindAndCapsADxf) {
  write_relief("one.ply", dome);
  const Answer answer =
      run_program("merge " + path("one.ply") + " --dxf mesh --dxf-faces 500 --stl-text -o " +
                  path("a.dxf") + " -o " + path("a.stl") + " -o " + path("a.glb"));
  expect_told(answer, 0, "from the original surface");
}

TEST_F(RegistrationProgram, MergeTakesTheUnitOfTheFilesAndKeepsSmallFiguresReadable) {
  write_relief("one.ply", dome);
  const auto noise_mm = [&](const std::string& options) {
    const Answer answer = run_program("--json merge " + path("one.ply") + " " + options + " -o " +
                                      path("a.ply") + " 2>/dev/null");
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    return nlohmann::json::parse(answer.output)["per_scan"][0]["noise_mm"].get<double>();
  };
  const double plain = noise_mm("");
  EXPECT_NEAR(noise_mm("--units cm") / plain, 10.0, 0.01);
  EXPECT_NEAR(noise_mm("--units 25.4mm") / noise_mm("--units in"), 1.0, 1e-6);
  const Answer tiny = run_program("merge " + path("one.ply") + " --units um -o " + path("b.ply"));
  EXPECT_TRUE(std::regex_search(tiny.output, std::regex("0\\.0000*[1-9][0-9][0-9]")))
      << tiny.output;
  EXPECT_EQ(
      run_program("merge " + path("one.ply") + " --units furlong -o " + path("c.ply")).exit_code,
      2);
}

TEST_F(RegistrationProgram, MergeWritesTheRefinedPosesAndWhyItDroppedPoints) {
  write_relief("one.ply", dome);
  write_relief("two.ply", dome);
  const Answer answer = run_program("--json merge " + path("one.ply") + " " + path("two.ply") +
                                    " --poses given --write-poses " + path("out.conf") + " -o " +
                                    path("a.ply") + " 2>/dev/null");
  const auto json = nlohmann::json::parse(answer.output);
  for (const auto& scan : json["per_scan"]) {
    EXPECT_GT(scan["points_read"], 0) << answer.output;
    EXPECT_EQ(scan["pose"]["rotation"].size(), 3U);
    EXPECT_TRUE(scan["dropped"].contains("hidden"));
  }
  expect_told(run_program("merge " + path("out.conf") + " -o " + path("b.ply")), 0, "triangles");
}

TEST_F(RegistrationProgram, AVoxelThatNeedsTooMuchMemoryIsRefusedWithOneThatFits) {
  write_relief("one.ply", dome);
  expect_refused("merge " + path("one.ply") + " --voxel 0.0001", 3, "mm fit");
}

TEST_F(RegistrationProgram, AViewAloneKeepsTheRigWithAWarning) {
  write_scan_of("blade", 1);
  expect_told(run_program("reconstruct " + path("scan") + " -o " + path("a.ply")),
              0,
              "one view alone cannot be registered");
  expect_refused("reconstruct " + path("scan") + " --voxel 0.0001", 3, "mm fit");
}

TEST_F(RegistrationProgram, AClipThatTakesAllIsRefused) {
  write_scan_of("blade", 1);
  expect_refused(
      "reconstruct " + path("scan") + " --clip-below 1000", 3, "nothing is left of the object");
  expect_refused(
      "reconstruct " + path("scan") + " --clip-radius 0.001", 3, "nothing is left of the object");
}

TEST_F(RegistrationProgram, AViewOfAPartThatWasPushedIsNamedAndLeftOut) {
  write_pushed_scan(1);
  const Answer answer = run_program("--quiet reconstruct " + path("scan") + " -o " + path("a.ply"));
  expect_told(answer, 4, "view 1 fits no other view: the part was elsewhere in it alone");
  EXPECT_EQ(answer.output.find("contradict each other"), std::string::npos) << answer.output;
}

TEST_F(RegistrationProgram, OppositeViewsWithLittleInCommonReportHowWellTheyDetermineTheAxis) {
  write_scan_of("blade", 2, 2);
  expect_told(run_program("reconstruct " + path("scan") + " -o " + path("a.ply")),
              0,
              "determine the axis only to");
}

TEST_F(RegistrationProgram, ViewsWithNothingInCommonKeepTheRigWithAWarning) {
  write_scan_of("plate", 2);
  expect_told(
      run_program("reconstruct " + path("scan") + " -o " + path("a.ply")), 0, "do not overlap");
}

TEST_F(RegistrationProgram, ScansThatDoNotOverlapKeepTheirPosesWithAWarning) {
  write_relief("one.ply", dome);
  write_relief("two.ply", [](double x, double y) { return 500.0 + dome(x, y); });
  expect_told(run_program("merge " + path("one.ply") + " " + path("two.ply") +
                          " --poses given -o " + path("a.ply")),
              4,
              "the scans do not overlap where their poses put them");
}

}  // namespace
}  // namespace frangia
