// Pictures by `frangia inspect` and `frangia picture`.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/files/write_mesh.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;

class PictureProgram : public ::testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (folder_.path() / name).string();
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(PictureProgram, ChecksThePathOfThePictureBeforeItReadsAMesh) {
  const std::string picture = at("nowhere/picture.png");
  for (const std::string& command :
       {"inspect " + at("missing.ply") + " --show shape --picture " + picture,
        "picture " + at("missing.ply") + " -o " + picture}) {
    const Answer answer = run_program(command);
    EXPECT_EQ(answer.exit_code, 3) << command;
    EXPECT_NE(answer.output.find("nowhere"), std::string::npos) << answer.output;
    EXPECT_EQ(answer.output.find("missing.ply"), std::string::npos) << answer.output;
  }
  const Answer answer = run_program("inspect " + at("missing.ply") + " --picture " + at("a.jpg"));
  EXPECT_NE(answer.output.find("a.jpg: pictures are written as PNG"), std::string::npos)
      << answer.output;
}

TEST_F(PictureProgram, NamesAFileOfPointsWithoutTriangles) {
  std::ofstream(at("points.xyz")) << "0 0 0\n1 0 0\n0 1 0\n";
  write_mesh(at("part.ply"), testing::box({0, 0, 0}, {10, 20, 30}));
  for (const std::string& command :
       {"inspect " + at("points.xyz") + " --show shape --picture " + at("a.png"),
        "inspect " + at("points.xyz") + " --reference " + at("part.ply"),
        "inspect " + at("part.ply") + " --reference " + at("points.xyz"),
        "picture " + at("points.xyz") + " -o " + at("a.png")}) {
    const Answer answer = run_program(command);
    EXPECT_EQ(answer.exit_code, 3) << command;
    EXPECT_NE(answer.output.find("points.xyz: it has 3 points and no triangles"), std::string::npos)
        << answer.output;
  }
}

/// The width in the header of a PNG, pixels.
int width_of(const std::filesystem::path& png) {
  std::ifstream stream(png, std::ios::binary);
  stream.seekg(16);
  int width = 0;
  for (int i = 0; i < 4; ++i)
    width = width * 256 + stream.get();
  return width;
}

TEST_F(PictureProgram, SaysWhatItWrote) {
  write_mesh(at("part.ply"), testing::box({0, 0, 0}, {10, 20, 30}));
  for (const auto& [command, file] :
       {std::pair("inspect " + at("part.ply") + " --show shape --width 64 --height 64 --picture ",
                  "a.png"),
        std::pair("picture " + at("part.ply") + " --width 64 --height 64 -o ", "b.png"),
        std::pair("edit " + at("part.ply") + " --remove-spikes -o ", "c.stl"),
        std::pair("edit " + at("part.ply") + " --orient --save-script ", "d.json")}) {
    const Answer answer = run_program(command + at(file));
    EXPECT_EQ(answer.exit_code, 0) << command;
    EXPECT_NE(answer.output.find("wrote " + at(file) + "\n"), std::string::npos) << answer.output;
  }
}

TEST_F(PictureProgram, TakesLengthsWithUnits) {
  write_mesh(at("part.ply"), testing::box({0, 0, 0}, {10, 20, 30}));
  const std::string inspect = "inspect " + at("part.ply") + " --reference " + at("part.ply");
  const Answer answer = run_program("--json " + inspect + " --within 0.01in --scale 50um");
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("\"completeness_within_mm\": 0.254"), std::string::npos)
      << answer.output;
  EXPECT_EQ(run_program(inspect + " --scale 0mm").exit_code, 2);
}

TEST_F(PictureProgram, AnEditChecksThePathsOfItsFilesBeforeTheWork) {
  for (const char* option : {"-o ", "--save-script ", "--preview "}) {
    const Answer answer = run_program("edit " + at("missing.ply") + " --remove-spikes " + option +
                                      at("nowhere/a.png"));
    EXPECT_EQ(answer.exit_code, 3) << option;
    EXPECT_EQ(answer.output.find("missing.ply"), std::string::npos) << answer.output;
  }
}

TEST_F(PictureProgram, AddsAColorScaleUnlessToldNotTo) {
  write_mesh(at("part.ply"), testing::box({0, 0, 0}, {10, 20, 30}));
  const std::string command =
      "inspect " + at("part.ply") + " --reference " + at("part.ply") + " --width 300 --height 225";
  EXPECT_EQ(run_program(command + " --picture " + at("scale.png")).exit_code, 0);
  EXPECT_EQ(run_program(command + " --no-legend --picture " + at("bare.png")).exit_code, 0);
  EXPECT_GT(width_of(at("scale.png")), 325);
  EXPECT_EQ(width_of(at("bare.png")), 300);
}

TEST_F(PictureProgram, TurnsTheDirectionUpUpright) {
  // A box that stands along y, and the same box standing along z.
  write_mesh(at("y.ply"), testing::box({0, 0, 0}, {10, 30, 20}));
  write_mesh(at("z.ply"), testing::box({0, -20, 0}, {10, 0, 30}));
  const auto picture = [&](const std::string& mesh, const std::string& up) {
    const Answer answer = run_program("picture " + at(mesh) + " --width 80 --height 64 --up " + up +
                                      " -o " + at("a.png"));
    EXPECT_EQ(answer.exit_code, 0) << answer.output;
    std::ifstream in(at("a.png"), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  EXPECT_EQ(picture("y.ply", "y"), picture("z.ply", "z"));
  EXPECT_EQ(picture("y.ply", "0,1,0"), picture("z.ply", "0,0,2"));
  EXPECT_NE(picture("y.ply", "y"), picture("y.ply", "z"));
  const Answer answer = run_program("picture " + at("y.ply") + " --up w -o " + at("a.png"));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_NE(answer.output.find("--up is \"w\"; it must be x, y, z"), std::string::npos)
      << answer.output;
}

}  // namespace
}  // namespace frangia
