// The response of a projector from fringes of few frames, by the program.
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/rig/read_rig.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::run_program;
using testing::TemporaryFolder;

class ResponseProgram : public ::testing::Test {
 protected:
  /// A scan of the plate with a rig.toml that has a comment and a device.
  void simulate(const std::string& options) const {
    const auto answer = run_program(
        fmt::format("--quiet simulate plate --views 1 {} -o {}", options, scan().string()));
    ASSERT_EQ(answer.exit_code, 0) << answer.output;
    std::ofstream rig(scan() / "rig.toml", std::ios::app);
    rig << "\n# left shelf\n[devices.turntable]\ndriver = \"simulated\"\n";
  }
  [[nodiscard]] std::filesystem::path scan() const { return folder_.path() / "scan"; }
  [[nodiscard]] std::filesystem::path output() const { return folder_.path() / "out.toml"; }
  TemporaryFolder folder_;
};

TEST_F(ResponseProgram, MeasuresAGammaFromGrayCodeAndThreeStepsAndKeepsTheRestOfTheRig) {
  simulate("--sequence gray --fringes 64 --shifts 3 --display-gamma 1.8");
  const auto answer =
      run_program(fmt::format("response {} -o {}", scan().string(), output().string()));
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("second harmonic 2"), std::string::npos) << answer.output;
  const Rig rig = read_rig(output());
  EXPECT_NEAR(rig.projector.response->light_of(0.5), 0.287, 0.02);  // 0.5^1.8
  ASSERT_EQ(rig.projector.waveforms.size(), 1U);
  EXPECT_NEAR(rig.projector.waveforms[0].amplitude(2), 0.8 / 3.8, 0.01);
  const std::string text = testing::text_of(output());
  EXPECT_NE(text.find("# left shelf\n[devices.turntable]"), std::string::npos);
}

TEST_F(ResponseProgram, NamesTheScanThatHasNoFringesOfADigitalProjector) {
  simulate("--rig angular --shifts 4");
  const auto answer =
      run_program(fmt::format("response {} -o {}", scan().string(), output().string()));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_NE(answer.output.find(scan().string() + ": has neither a pattern"), std::string::npos)
      << answer.output;
}

}  // namespace
}  // namespace frangia
