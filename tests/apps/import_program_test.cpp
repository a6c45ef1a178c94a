// The verb import: from images of other programs to a scan that decodes.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_on_terminal.h"
#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_on_terminal;
using testing::run_program;
using testing::run_shell;
using testing::TemporaryFolder;

class ImportProgram : public ::testing::Test {
 protected:
  /// A simulated scan, whose frames are the images to import.
  void SetUp() override {
    testing::small_scan(folder_.path() / "made", "plate", "digital", 1, {.samples_per_px = 1}, 4);
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return "'" + (folder_.path() / name).string() + "'";
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }
  /// Patterns and rig of the simulated scan.
  [[nodiscard]] std::string known() const {
    return " --patterns " + path("made/scan.toml") + " --rig " + path("made/rig.toml");
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ImportProgram, MakesAScanThatDecodesAsTheOriginal) {
  const Answer answer = run_program("import " + path("made/views/0") + " -o " + path("scan") +
                                    " --names '{pattern}-{frame}.png'" + known());
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("12 images fit {pattern}-{frame}.png"), std::string::npos)
      << answer.output;
  for (const char* scan : {"made", "scan"}) {
    const Answer decoded =
        run_program("--quiet decode " + path(scan) + " -o " + path(std::string(scan) + "-stages"));
    ASSERT_EQ(decoded.exit_code, 0) << decoded.output;
  }
  EXPECT_EQ(run_shell("cmp " + path("made-stages/absolute.tiff") + " " +
                      path("scan-stages/absolute.tiff"))
                .exit_code,
            0);
}

TEST_F(ImportProgram, AsksBeforeItTrustsAGuess) {
  const std::string command = "import " + path("made/views/0") + " -o " + path("scan") + known();
  const Answer refused = run_program(command + " </dev/null");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.output.find("the template '{pattern}-{frame}.png' is guessed; set --names to "
                                "it, or set --yes to accept the guess"),
            std::string::npos)
      << refused.output;
  const Answer declined = run_on_terminal(command, "n\n");
  EXPECT_EQ(declined.exit_code, 3) << declined.output;
  EXPECT_FALSE(exists("scan"));
  const Answer accepted = run_on_terminal(command, "y\n");
  EXPECT_EQ(accepted.exit_code, 0) << accepted.output;
  EXPECT_NE(accepted.output.find("Import these frames? [y/N]"), std::string::npos)
      << accepted.output;
  EXPECT_TRUE(exists("scan/scan.toml"));
}

/// OpenCV writes JPEGs of the frames. Without it, the test is skipped.
TEST_F(ImportProgram, CountsTheNoiseOfJpegsInSigma) {
  const std::string script =
      "import cv2, glob, sys\n"
      "for f in glob.glob(sys.argv[1] + '/*.png'):\n"
      "    cv2.imwrite(f[:-3] + 'jpg', cv2.imread(f, -1), [cv2.IMWRITE_JPEG_QUALITY, 75])\n";
  const std::string python = "/usr/bin/python3 -c \"" + script + "\" " + path("made/views/0");
  if (run_shell("/usr/bin/python3 -c 'import cv2'").exit_code != 0)
    GTEST_SKIP() << "needs python3-opencv";
  ASSERT_EQ(run_shell(python).exit_code, 0);
  const Answer answer =
      run_program("--json import " + path("made/views/0") + " -o " + path("scan") +
                  " --names '{pattern}-{frame}.jpg'" + known() + " 2>/dev/null");
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json["jpeg_quality"], 75);
  EXPECT_GT(json["compression_counts2"], 3.0);
  const Answer warned = run_program("import " + path("made/views/0") + " -o " + path("again") +
                                    " --names '{pattern}-{frame}.jpg'" + known());
  EXPECT_NE(warned.output.find("warning: the frames are JPEGs of quality 75: the compression adds "
                               "noise of 2.1 counts to each pixel"),
            std::string::npos)
      << warned.output;
}

TEST_F(ImportProgram, ImportsTwoCamerasWithTheirRig) {
  ASSERT_EQ(run_shell("mkdir -p " + path("both/left") + " " + path("both/right") + " && cp " +
                      path("made/views/0") + "/*.png " + path("both/left") + " && cp " +
                      path("made/views/0") + "/*.png " + path("both/right"))
                .exit_code,
            0);
  const std::string patterns = " --yes --patterns " + path("made/scan.toml");
  const Answer sizes = run_program("--json import " + path("both") + " -o " + path("sizes") +
                                   " --reference right --projector 1280x800" + patterns);
  ASSERT_EQ(sizes.exit_code, 0) << sizes.output;
  const auto json = nlohmann::json::parse(sizes.output);
  EXPECT_EQ(json["names"], "{camera}/{pattern}-{frame}.png");
  EXPECT_TRUE(exists("sizes/views/000/left"));
  // A calibration of two cameras, as OpenCV's stereo_calib writes it.
  std::ofstream(path("stereo.yml").substr(1, path("stereo.yml").size() - 2))
      << "%YAML:1.0\n---\n"
         "M1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
         "   data: [ 900., 0., 99.5, 0., 900., 79.5, 0., 0., 1. ]\n"
         "M2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
         "   data: [ 910., 0., 98.5, 0., 910., 78.5, 0., 0., 1. ]\n"
         "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
         "   data: [ 0.8, 0., 0.6, 0., 1., 0., -0.6, 0., 0.8 ]\n"
         "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ -80., 0., 60. ]\n";
  const std::string size =
      fmt::format("{},{}", json["size_px"][0].get<int>(), json["size_px"][1].get<int>());
  const Answer rig =
      run_program("calibrate import " + path("stereo.yml") + " -o " + path("rig.toml") +
                  " --second-camera right --camera-size " + size + " --projector-size 1280,800");
  ASSERT_EQ(rig.exit_code, 0) << rig.output;
  EXPECT_NE(rig.output.find("baseline 100.00 mm"), std::string::npos) << rig.output;
  const Answer scan = run_program("import " + path("both") + " -o " + path("scan") + patterns +
                                  " --rig " + path("rig.toml"));
  ASSERT_EQ(scan.exit_code, 0) << scan.output;
  EXPECT_TRUE(exists("scan/views/000/right"));
  // position = -R^T T
  EXPECT_EQ(run_shell("grep -q 'position_mm = \\[100' " + path("scan/rig.toml")).exit_code, 0);
  ASSERT_EQ(run_shell("mv " + path("both/right") + " " + path("both/camera")).exit_code, 0);
  const Answer other = run_program("import " + path("both") + " -o " + path("other") + patterns +
                                   " --rig " + path("rig.toml"));
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.output.find("2 of the cameras camera, left are not in more_cameras"),
            std::string::npos)
      << other.output;
}

TEST_F(ImportProgram, NamesTheOptionOfAFault) {
  const auto complaint = [&](const std::string& options) {
    const Answer answer =
        run_program("import " + path("made/views/0") + " -o " + path("scan") + " " + options);
    EXPECT_EQ(answer.exit_code, 3) << answer.output;
    EXPECT_FALSE(exists("scan"));
    return answer.output;
  };
  EXPECT_EQ(complaint("--names '{pattern}_{frame}.png' --period 20").find("frangia: "), 0U);
  EXPECT_NE(complaint("--names '{pattern}-{frame}.png' --fringes 1,8").find("set --projector"),
            std::string::npos);
  EXPECT_NE(complaint("--projector 10").find("--projector is \"10\"; write WIDTHxHEIGHT"),
            std::string::npos);
  EXPECT_NE(complaint("--raw 8x8").find("--raw is \"8x8\"; write WIDTHxHEIGHTxBITS"),
            std::string::npos);
  EXPECT_NE(complaint("--color pink").find("--color is \"pink\"; it must be red"),
            std::string::npos);
  EXPECT_NE(complaint("--fringes none").find("--fringes holds \"none\""), std::string::npos);
}

}  // namespace
}  // namespace frangia
