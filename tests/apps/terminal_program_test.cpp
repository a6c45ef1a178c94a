// What the program shows while it works, and how it ends.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/pseudo_terminal_test.h"
#include "support/run_on_terminal.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_on_terminal;
using testing::run_program;
using testing::run_shell;
using testing::TemporaryFolder;

bool shows(const Answer& answer, const std::string& part) {
  return answer.output.find(part) != std::string::npos;
}

/// Sum of the two numbers that a regular expression captured.
int sum_of(const std::smatch& found) {
  return std::stoi(found.str(1)) + std::stoi(found.str(2));
}

std::string rig_file() {
  return std::string(FRANGIA_SOURCE_DIR) + "/tests/data/small-interferometer.toml";
}

/// A digital rig with few pixels.
std::string with_small_rig() {
  return " --rig " + std::string(FRANGIA_SOURCE_DIR) + "/examples/python/small-rig.toml";
}

class TerminalProgram : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }
  void simulate(const std::string& arguments) const {
    const Answer answer = run_program("simulate " + arguments + " -o " + path("scan"));
    ASSERT_EQ(answer.exit_code, 0) << answer.output;
  }
  TemporaryFolder folder_;
};

TEST_F(TerminalProgram, ShowsASummaryByDefaultAndTheRestUnderVerbose) {
  simulate("ball-bar --views 1" + with_small_rig());
  const std::string reconstruct = "reconstruct " + path("scan") + " -o " + path("a.ply");
  const Answer brief = run_program(reconstruct);
  EXPECT_EQ(brief.exit_code, 0);
  EXPECT_TRUE(shows(brief, "points from 1 view -> ")) << brief.output;
  EXPECT_TRUE(shows(brief, " triangles, median sigma 0.")) << brief.output;
  EXPECT_FALSE(shows(brief, "systematic")) << brief.output;
  EXPECT_TRUE(shows(brief, "wrote " + path("a.ply"))) << brief.output;
  EXPECT_FALSE(shows(brief, "algorithm") || shows(brief, "contrast") || shows(brief, " MB"))
      << brief.output;
  EXPECT_LE(std::count(brief.output.begin(), brief.output.end(), '\n'), 8) << brief.output;
  const Answer all = run_program("--verbose " + reconstruct);
  EXPECT_TRUE(shows(all, "contrast") && shows(all, " MB")) << all.output;
}

TEST_F(TerminalProgram, SaysOnceWhatIsAlikeInSeveralViews) {
  simulate("ball-bar --views 4 --samples 1 --flicker 0.04" + with_small_rig());
  const std::string decode = "decode " + path("scan") + " -o " + path("maps");
  const auto count = [](const Answer& answer, const std::string& part) {
    int found = 0;
    for (std::size_t at = 0; (at = answer.output.find(part, at)) != std::string::npos; ++at)
      ++found;
    return found;
  };
  const std::string of_view = "warning: views/";
  const Answer brief = run_program(decode);
  EXPECT_TRUE(shows(brief, " more alike (--verbose): pattern \"")) << brief.output;
  const int all = count(run_program("--verbose " + decode), of_view);
  EXPECT_GT(all, 2 * count(brief, of_view)) << brief.output;
  const Answer json = run_program("--json " + decode + " 2>/dev/null");
  EXPECT_FALSE(shows(json, "alike (")) << json.output;
}

TEST_F(TerminalProgram, PrintsOneLineForEachView) {
  simulate("ball-bar --views 2" + with_small_rig());
  const std::string reconstruct = "reconstruct " + path("scan") + " -o " + path("a.ply");
  const Answer answer = run_program(reconstruct);
  EXPECT_EQ(answer.exit_code, 0);
  const std::regex table(
      R"(view +angle deg +points +sigma mm\nviews/000 +0\.00 +(\d+) +0\.\d{4}\nviews/001 +180\.00 +(\d+) +0\.\d{4}\n)");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(answer.output, found, table)) << answer.output;
  EXPECT_TRUE(shows(answer, fmt::format("\n{} points from 2 views", sum_of(found))))
      << answer.output;
  EXPECT_FALSE(shows(answer, "-0.0")) << answer.output;
  const Answer json = run_program("--json " + reconstruct + " 2>/dev/null");
  EXPECT_TRUE(shows(json, "\"view\": \"views/001\"")) << json.output;
  const Answer quiet = run_program("--quiet " + reconstruct);
  EXPECT_FALSE(shows(quiet, "points from") || shows(quiet, "views/000")) << quiet.output;
}

TEST_F(TerminalProgram, SaysWhatItWrote) {
  const Answer simulated = run_program("simulate plate --views 1 -o " + path("scan"));
  EXPECT_TRUE(shows(simulated, "wrote " + path("scan") + ": 1 view of 3 patterns"))
      << simulated.output;
  const Answer calibrated =
      run_program("calibrate piezo " + rig_file() + " --steps 13 -o " + path("rig.toml"));
  EXPECT_TRUE(shows(calibrated, "wrote " + path("rig.toml"))) << calibrated.output;
}

TEST_F(TerminalProgram, TakesLengthsWithUnits) {
  simulate("ball-bar --views 1" + with_small_rig());
  const auto triangles = [&](const std::string& voxel) {
    const Answer answer = run_program("--json reconstruct " + path("scan") + " --voxel " + voxel +
                                      " -o " + path("a.ply") + " 2>/dev/null");
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    std::smatch found;
    std::regex_search(answer.output, found, std::regex(R"("triangles": (\d+))"));
    return found.str(1);
  };
  EXPECT_EQ(triangles("2.54"), triangles("0.1in"));
  EXPECT_EQ(triangles("2mm"), triangles("0.2cm"));
}

TEST_F(TerminalProgram, NamesTheLimitThatRejectedAllPixels) {
  simulate("ball-bar --views 1" + with_small_rig());
  const Answer answer =
      run_program("--quiet reconstruct " + path("scan") + " --max-sigma 1e-9 -o " + path("a.ply"));
  EXPECT_EQ(answer.exit_code, 5);  // no view is left
  EXPECT_TRUE(shows(answer, "less certain than --max-sigma, 1e-09 rad")) << answer.output;
}

TEST_F(TerminalProgram, NamesAVoxelThatIsLargerThanThePart) {
  simulate("ball-bar --views 2" + with_small_rig());
  const Answer answer =
      run_program("--quiet reconstruct " + path("scan") + " --voxel 500mm -o " + path("a.ply"));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(shows(answer, "voxel of 500 mm") && shows(answer, "smaller --voxel"))
      << answer.output;
}

TEST_F(TerminalProgram, NamesAnEmptyFrame) {
  simulate("plate --views 1");
  std::filesystem::resize_file(folder_.path() / "scan/views/000/p1280-0.png", 0);
  const Answer answer = run_program("--quiet reconstruct " + path("scan") + " -o " + path("a.ply"));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(shows(answer, "p1280-0.png: is an empty file of 0 bytes")) << answer.output;
}

TEST_F(TerminalProgram, NamesAMeshWithoutTriangles) {
  std::ofstream(path("points.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n0 0 0\n";
  const Answer answer = run_program("picture " + path("points.ply") + " -o " + path("a.png"));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(shows(answer, "no triangles")) << answer.output;
  EXPECT_FALSE(shows(answer, "render_mesh")) << answer.output;
}

TEST_F(TerminalProgram, RefusesOptionsThatTheRigCannotShow) {
  const auto refused = [&](const std::string& options, const std::string& sentence) {
    const Answer answer = run_program("simulate plate " + options + " -o " + path("scan"));
    EXPECT_EQ(answer.exit_code, 3) << options;
    EXPECT_TRUE(shows(answer, sentence)) << answer.output;
    EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1) << answer.output;
    EXPECT_FALSE(std::filesystem::exists(path("scan"))) << options;
  };
  refused("--rig angular --periods 100", "--periods is for a digital projector");
  refused("--fringes-per-degree 5", "--fringes-per-degree is for an angular projector");
  refused("--periods 1.5", "a fringe period");
  refused("--rig angular --sequence doubling --fringes 1e300", "fringes");
  const Answer plan = run_program("plan --fringes 1e300");
  EXPECT_EQ(plan.exit_code, 3);
  EXPECT_EQ(std::count(plan.output.begin(), plan.output.end(), '\n'), 1) << plan.output;
}

TEST_F(TerminalProgram, AnUnfinishedScanIsNamedAsSuch) {
  std::filesystem::create_directories(folder_.path() / "scan/capture");
  const Answer answer = run_program("reconstruct " + path("scan") + " -o " + path("a.ply"));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(shows(answer, "`frangia scan`")) << answer.output;
}

TEST_F(TerminalProgram, TheDemoDeletesNothingThatItDidNotWrite) {
  const auto kept = folder_.path() / "bust-scan/notes.txt";
  std::filesystem::create_directories(kept.parent_path());
  std::ofstream(kept) << "mine";
  const Answer answer = run_program("demo -o " + folder_.path().string());
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(shows(answer, "holds files that `frangia demo` did not write")) << answer.output;
  EXPECT_TRUE(std::filesystem::exists(kept));
}

TEST_F(TerminalProgram, PrintsTheCommandThatContinuesAnInterruptedScan) {
  const std::string command =
      fmt::format("{} scan '{}' -o '{}' --views 300", FRANGIA_PROGRAM, rig_file(), path("a scan"));
  const Answer stopped = run_shell(fmt::format(
      "{} & until ls '{}'/views/*/*-1.png >/dev/null 2>&1 || ! kill -0 $!; do sleep 0.05; done; "
      "kill -INT $!; wait $!",
      command,
      path("a scan")));
  EXPECT_EQ(stopped.exit_code, 130) << stopped.output;
  EXPECT_TRUE(shows(stopped,
                    fmt::format("continue with: {} scan {} -o '{}' --views 300",
                                FRANGIA_PROGRAM,
                                rig_file(),
                                path("a scan"))))
      << stopped.output;
}

class ProgressOnTerminal : public testing::PseudoTerminalTest {
 protected:
  TemporaryFolder folder_;
};

TEST_F(ProgressOnTerminal, TheBarOfAStageNeverRunsBackwards) {
  const std::string scan = (folder_.path() / "scan").string();
  const Answer simulated =
      run_on_terminal("simulate bracket --views 6 --rig " + std::string(FRANGIA_SOURCE_DIR) +
                      "/examples/python/small-rig.toml -o " + scan);
  ASSERT_EQ(simulated.exit_code, 0) << simulated.output;
  const Answer answer = run_on_terminal("reconstruct " + scan + " -o " + scan + ".ply");
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const std::string shown = simulated.output + answer.output;
  const std::regex bar(R"(\x1b\[K(\w+) +\[[= ]*\] +(\d+) %)");
  std::map<std::string, int> percent;
  for (std::sregex_iterator i(shown.begin(), shown.end(), bar), end; i != end; ++i) {
    const int now = std::stoi((*i)[2]);
    EXPECT_GE(now, percent[(*i)[1]]) << (*i)[1];
    percent[(*i)[1]] = now;
  }
  EXPECT_FALSE(percent.empty());
}

}  // namespace
}  // namespace frangia
