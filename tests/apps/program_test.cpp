// Exit codes, one sentence on standard error, and no half-written files.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::TemporaryFolder;

std::string quoted(const std::filesystem::path& path) {
  return "'" + path.string() + "'";
}

/// Two views of a ball bar by an angular rig, simulated once for all tests.
class Program : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = new TemporaryFolder;  // NOLINT(*-owning-memory) deleted below
    const Answer answer =
        run_program("simulate ball-bar --rig angular --views 2 -o " + quoted(scan()));
    ASSERT_EQ(answer.exit_code, 0) << answer.output;
  }
  static void TearDownTestSuite() { delete shared_; }  // NOLINT(*-owning-memory)

  [[nodiscard]] static std::filesystem::path scan() { return shared_->path() / "scan"; }
  [[nodiscard]] std::filesystem::path out(const std::string& name) const {
    return folder_.path() / name;
  }

 private:
  static TemporaryFolder* shared_;
  TemporaryFolder folder_;
};

TemporaryFolder* Program::shared_ = nullptr;

TEST_F(Program, SimulatesAndReconstructsToEveryFormat) {
  const Answer answer =
      run_program("reconstruct " + quoted(scan()) + " -o " + quoted(out("a.dxf")) + " -o " +
                  quoted(out("a.ply")) + " -o " + quoted(out("a.stl")));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  for (const char* name : {"a.dxf", "a.ply", "a.stl"})
    EXPECT_GT(std::filesystem::file_size(out(name)), 10000U) << name;
}

TEST_F(Program, AnswersMachinesInJson) {
  // Warnings go to standard error; standard output holds JSON alone.
  const Answer answer = run_program("--json reconstruct " + quoted(scan()) + " -o " +
                                    quoted(out("a.ply")) + " 2>/dev/null");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.output.front(), '{') << answer.output;
  EXPECT_NE(answer.output.find("\"triangles\""), std::string::npos);
  EXPECT_NE(answer.output.find("\"trustworthy\": true"), std::string::npos) << answer.output;
}

TEST_F(Program, DecodesTheStagesOfOneView) {
  const Answer answer =
      run_program("decode " + quoted(scan()) + " --view 1 -o " + quoted(out("stages")));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  for (const char* name : {"fringe-wrapped.png",
                           "fringe-wrapped.tiff",
                           "fringe-residues.png",
                           "fringe-modulation.png",
                           "fringe-sigma.png",
                           "growth.png",
                           "regions.png",
                           "relative.png",
                           "mask.png",
                           "fringes.png",
                           "absolute.png",
                           "depth.tiff",
                           "index.html"}) {
    EXPECT_TRUE(std::filesystem::exists(out("stages") / name)) << name;
    if (std::filesystem::path(name).extension() == ".png") {
      EXPECT_NE(answer.output.find(name), std::string::npos) << answer.output;
    }
  }
  EXPECT_NE(answer.output.find("white: measured"), std::string::npos) << answer.output;
}

TEST_F(Program, PreviewsAnEditAndWritesNoMesh) {
  const auto mesh = out("box.off");
  std::ofstream(mesh) << "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n"
                         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  const std::string edit = "edit " + quoted(mesh) + " --select-plane 0,0,1,8mm --delete --preview ";
  const Answer answer = run_program(edit + quoted(out("look.png")));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("would be removed or moved"), std::string::npos) << answer.output;
  EXPECT_GT(std::filesystem::file_size(out("look.png")), 1000U);
  EXPECT_EQ(run_program(edit + quoted(out("look.jpg"))).exit_code, 3);
}

void expect_usage_error(const std::string& arguments, const std::string& sentence) {
  const Answer answer = run_program(arguments);
  EXPECT_EQ(answer.exit_code, 2) << arguments;
  EXPECT_EQ(answer.output, fmt::format("frangia: {}\n", sentence)) << arguments;
}

TEST_F(Program, UsageErrorsExitWithTwoAndOneSentence) {
  EXPECT_EQ(run_program("").exit_code, 2);
  expect_usage_error("fly", "the program has no verb fly; see frangia --help");
  expect_usage_error(
      "recnstruct x",
      "the program has no verb recnstruct, perhaps reconstruct was meant; see frangia --help");
  expect_usage_error(
      "calibrate",
      "calibrate needs a verb: board, targets, capture, rig, turntable, check, import, export, "
      "refine, display, piezo; see frangia calibrate --help");
  expect_usage_error(
      "calibrate peizo x",
      "calibrate has no verb peizo, perhaps piezo was meant; see frangia calibrate --help");
  expect_usage_error("calibrate piezo x --stps 9",
                     "calibrate piezo has no option --stps, perhaps --steps was meant; see "
                     "frangia calibrate piezo --help");
  expect_usage_error("demo --jsn",
                     "demo has no option --jsn, perhaps --json was meant; see frangia demo --help");
  expect_usage_error("reconstruct x --ouput y.ply",
                     "reconstruct has no option --ouput, perhaps --output was meant; see frangia "
                     "reconstruct --help");
  expect_usage_error("reconstruct", "SCAN is required; see frangia reconstruct --help");
  expect_usage_error("reconstruct x -o", "--output needs a value; see frangia reconstruct --help");
  expect_usage_error(
      "reconstruct x y -o z.ply",
      "y is one argument more than reconstruct takes; see frangia reconstruct --help");
  expect_usage_error("reconstruct x -o z.ply --voxel 1 mm",
                     "mm is one argument more than reconstruct takes; write a number and its unit "
                     "as one word, such as 1mm; see frangia reconstruct --help");
  expect_usage_error("edit x.ply --decimate wide",
                     "--decimate: 'wide' is not SIZE; a size is a length greater than 0, in mm or "
                     "with a unit: 10, 10mm, 1cm, 0.5in; see frangia edit --help");
  expect_usage_error("inspect x.ply --features --align best-fit",
                     "--align needs a --reference to align the mesh to; give one; see frangia "
                     "inspect --help");
  expect_usage_error("help fly", "the program has no verb fly; see frangia --help");
  expect_usage_error("reconstruct x --voxl 3 -o z.ply",
                     "reconstruct has no option --voxl, perhaps --voxel was meant; see frangia "
                     "reconstruct --help");
}

TEST_F(Program, NamesTheAllowedValuesOfAnOption) {
  const auto expect = [](const std::string& options, const std::string& sentence) {
    expect_usage_error("reconstruct x -o y.ply " + options,
                       sentence + "; see frangia reconstruct --help");
  };
  for (const char* wrong : {"0", "-3", "0mm"}) {
    expect(fmt::format("--voxel {}", wrong),
           fmt::format("--voxel: {} is not a length above 0", wrong));
  }
  for (const char* wrong : {"nan", "inf", "wide", "1km"}) {
    expect(
        fmt::format("--voxel {}", wrong),
        fmt::format("--voxel: '{}' is not a length: write a number and um, mm, cm, m or in, such "
                    "as 1.5mm",
                    wrong));
  }
  expect("--voxel 1 --voxel 2", "--voxel is given more than once");
  expect("--clip-below low",
         "--clip-below: 'low' is not a length: write a number and um, mm, cm, m or in, such as "
         "1.5mm");
  expect("--dxf-faces -1", "--dxf-faces: -1 is not a number of 0 or more");
  expect("--dxf-faces 2.5", "--dxf-faces cannot be 2.5");
  expect("--unwrap 1", "--unwrap: 1 is not one of run-merging, quality-guided, reliability-sorted");
}

TEST_F(Program, ShowsTheHelpOfAVerbByItsName) {
  EXPECT_EQ(run_program("help calibrate board").output,
            run_program("calibrate board --help").output);
  EXPECT_EQ(run_program("help edit").exit_code, 0);
  EXPECT_EQ(run_program("help").output, run_program("--help").output);
}

TEST_F(Program, SaysThatAnEditedMeshWasNotSaved) {
  const auto mesh = out("pyramid.off");
  std::ofstream(mesh) << "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n"
                         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  const std::string edit = "edit " + quoted(mesh) + " --orient";
  for (const char* more : {"", " --list"}) {
    const Answer answer = run_program(edit + more);
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    EXPECT_NE(answer.output.find("the mesh was not saved"), std::string::npos) << answer.output;
  }
  EXPECT_EQ(run_program("edit " + quoted(mesh) + " --list").output.find("not saved"),
            std::string::npos);
}

TEST_F(Program, ShowsAnExampleInTheHelpOfEveryVerb) {
  for (const char* verb : {"demo", "simulate", "reconstruct", "decode", "inspect"}) {
    const Answer answer = run_program(fmt::format("{} --help", verb));
    EXPECT_EQ(answer.exit_code, 0);
    EXPECT_NE(answer.output.find(fmt::format("frangia {}", verb)), std::string::npos) << verb;
  }
}

void expect_bad_input(const Answer& answer, const std::string& names) {
  EXPECT_EQ(answer.exit_code, 3) << answer.output;
  EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1) << answer.output;
  EXPECT_NE(answer.output.find(names), std::string::npos) << answer.output;
}

TEST_F(Program, BadInputExitsWithThreeAndOneSentence) {
  expect_bad_input(run_program("reconstruct /nowhere -o " + quoted(out("a.ply"))), "/nowhere");
  expect_bad_input(run_program("simulate teapot -o " + quoted(out("teapot"))), "teapot");
  expect_bad_input(run_program("reconstruct " + quoted(scan()) + " -o " + quoted(out("a.doc"))),
                   "a.doc");
  expect_bad_input(run_program("decode " + quoted(scan()) + " --view 9 -o " + quoted(out("d"))),
                   "has no --view 9");
}

TEST_F(Program, RefusesAnUnwritableOutputBeforeTheWork) {
  expect_bad_input(run_program("reconstruct " + quoted(scan()) + " -o /nowhere/a.ply"),
                   "/nowhere/a.ply");
}

TEST_F(Program, LeavesNothingUnderTheFinalNameWhenAFrameIsBroken) {
  std::filesystem::copy(scan(), out("scan"), std::filesystem::copy_options::recursive);
  std::filesystem::resize_file(out("scan/views/001/fringe-1.png"), 200);
  expect_bad_input(
      run_program("--quiet reconstruct " + quoted(out("scan")) + " -o " + quoted(out("a.ply"))),
      "fringe-1.png");
  EXPECT_FALSE(std::filesystem::exists(out("a.ply")));
  for (const auto& entry : std::filesystem::directory_iterator(out("")))
    EXPECT_EQ(entry.path().filename(), "scan");
}

}  // namespace
}  // namespace frangia
