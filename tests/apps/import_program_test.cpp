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
    testing::small_scan(folder_.path() / "made", "plate", "digital", 1, {.samples_per_px = 1});
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
