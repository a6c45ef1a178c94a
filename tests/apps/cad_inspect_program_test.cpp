// CAD references of `frangia inspect`.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/files/write_mesh.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

class CadInspectProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string command =
        std::string(FRANGIA_MAKE_CAD_PARTS) + " " + folder_.path().string() + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    // The ball of primitives.step is 40 mm wide and 200 mm from the origin.
    write_mesh(at("ball.ply"), testing::sphere({200, 0, 0}, 20.01, 45));
  }
  [[nodiscard]] std::string at(const std::string& name) const {
    return (folder_.path() / name).string();
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(CadInspectProgram, MeasuresToTheExactFaceAndStatesItsNominalSize) {
  const auto answer = testing::run_program("--json inspect " + at("ball.ply") + " --reference " +
                                           at("primitives.step") + " --features");
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json.at("reference").at("unit"), "millimetre");
  // Vertices are rounded to single precision, 1e-5 mm here; the tessellation is off by 0.02 mm.
  EXPECT_NEAR(json.at("deviation").at("min_mm").get<double>(), 0.01, 3e-5);
  EXPECT_NEAR(json.at("deviation").at("max_mm").get<double>(), 0.01, 3e-5);
  EXPECT_NEAR(json.at("rms_mm").get<double>(), 0.01, 3e-5);
  ASSERT_EQ(json.at("feature_details").size(), 1U);
  const auto& nominal = json.at("feature_details")[0].at("nominal");
  EXPECT_NEAR(nominal.at("diameter_mm").get<double>(), 40.0, 1e-9);
  EXPECT_NEAR(nominal.at("difference_mm").get<double>(), 0.02, 1e-3);
}

// OpenCASCADE's libraries are three quarters of a start; a program that reads no CAD file does
// without.
TEST_F(CadInspectProgram, LoadsOpenCascadeWhenACadFileIsReadAndSaysWhereItIsMissing) {
  const auto libraries = testing::run_shell("ldd " FRANGIA_PROGRAM);
  ASSERT_EQ(libraries.exit_code, 0) << libraries.output;
  EXPECT_NE(libraries.output.find("libstdc++"), std::string::npos);
  EXPECT_EQ(libraries.output.find("libTK"), std::string::npos) << libraries.output;

  std::filesystem::create_directory(at("bin"));
  std::filesystem::copy_file(FRANGIA_PROGRAM, at("bin/frangia"));
  const auto answer = testing::run_shell(at("bin/frangia") + " inspect " + at("ball.ply") +
                                         " --reference " + at("primitives.step"));
  EXPECT_EQ(answer.exit_code, 3) << answer.output;
  EXPECT_NE(
      answer.output.find("/lib/frangia/frangia_cad.so, which reads CAD files, cannot be loaded"),
      std::string::npos)
      << answer.output;
  EXPECT_NE(testing::run_shell(at("bin/frangia") + " inspect " + at("ball.ply") + " --reference " +
                               at("ball.ply"))
                .exit_code,
            3);
}

TEST_F(CadInspectProgram, TakesTheNominalOfAPlannedFeatureFromItsFace) {
  const std::string plan = at("inspection.toml");
  const auto write = [&](const std::string& feature) {
    std::ofstream(plan) << "format = \"frangia-inspection\"\nversion = 1\nreference = "
                           "\"primitives.step\"\n[[features]]\nname = \"ball\"\n"
                        << feature << "\ntolerance_mm = [-0.05, 0.05]\n";
  };
  const std::string command = "--json inspect " + at("ball.ply") + " --plan " + plan;
  write("kind = \"sphere\"\nnear_mm = [199, 0, 0]");
  auto answer = testing::run_program(command);
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto row = nlohmann::json::parse(answer.output).at("characteristics").at(0);
  EXPECT_NEAR(row.at("nominal").get<double>(), 40.0, 1e-9);
  EXPECT_EQ(row.at("conformity"), "in");
  write("face = 10");  // six of the box and three of the cylinder come before
  answer = testing::run_program(command);
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_EQ(nlohmann::json::parse(answer.output).at("characteristics").at(0), row);
  write("face = 99");
  answer = testing::run_program(command);
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_NE(answer.output.find("inspection.toml: feature \"ball\": face = 99"), std::string::npos)
      << answer.output;
  write("face = 1");
  EXPECT_NE(testing::run_program(command).output.find("which a plane does not have"),
            std::string::npos);
  answer = testing::run_program(command + " --reference " + at("ball.ply"));
  EXPECT_NE(answer.output.find("the reference is no CAD model"), std::string::npos)
      << answer.output;
}

TEST_F(CadInspectProgram, RefusesADamagedReferenceInASentence) {
  const std::string data = FRANGIA_SOURCE_DIR "/tests/data/cad/";
  const auto inspect = [&](const std::string& reference, const std::string& more = "") {
    return testing::run_program("inspect " + at("ball.ply") + " --align none --reference " +
                                reference + more);
  };
  const auto damaged = inspect(data + "step-one-token-changed.stp");
  EXPECT_EQ(damaged.exit_code, 3) << damaged.output;
  EXPECT_NE(damaged.output.find("step-one-token-changed.stp: it"), std::string::npos)
      << damaged.output;
  const auto endless = inspect(data + "step-nan.step", " --allow-time 1");
  EXPECT_EQ(endless.exit_code, 3) << endless.output;
  EXPECT_NE(endless.output.find("step-nan.step: it takes more than 1 s"), std::string::npos)
      << endless.output;
  EXPECT_NE(endless.output.find("raise --allow-time"), std::string::npos) << endless.output;
}

}  // namespace
}  // namespace frangia
