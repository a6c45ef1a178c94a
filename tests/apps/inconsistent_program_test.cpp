// Frames that do not fit scan.toml or the rig, and frames without a rig. They are made by the
// equations of two pinholes, not by the simulator.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::TemporaryFolder;

constexpr int kCameraWidth = 240;
constexpr int kCameraHeight = 160;
constexpr double kDegree = 3.141592653589793 / 180.0;

/// What the projector really does, unlike scan.toml.
struct Fault {
  std::string pattern;  ///< whose frames begin late
  double late_deg = 0.0;
  bool mirrored = false;   ///< the projector, left to right
  bool exchanged = false;  ///< rows and columns
};

/// A scan of a bumpy wall with three vertical and three horizontal patterns.
class BumpyWall {
 public:
  explicit BumpyWall(const Fault& fault = {}) {
    std::filesystem::create_directories(path() / "views/000");
    std::string patterns;
    for (const bool vertical : {true, false}) {
      for (const int period : {vertical ? 640 : 480, 80, 20}) {
        const std::string name = fmt::format("{}{}", vertical ? "c" : "r", period);
        patterns += fmt::format(
            "[[pattern]]\nname = \"{}\"\nkind = \"fringe\"\ndirection = \"{}\"\nperiod_px = {}\n"
            "shifts_deg = [0, 90, 180, 270]\n",
            name,
            vertical ? "vertical" : "horizontal",
            period);
        const bool columns = vertical != fault.exchanged;
        for (int k = 0; k < 4; ++k) {
          const double shift = 90.0 * k + (name == fault.pattern ? fault.late_deg : 0.0);
          write_frame(name, k, columns, period, shift * kDegree, fault.mirrored);
        }
      }
    }
    std::ofstream(path() / "scan.toml") << "format = \"frangia-scan\"\nversion = 2\n"
                                        << patterns << "[[view]]\nfolder = \"views/000\"\n";
    const double angle = turn();
    std::ofstream(path() / "rig.toml") << fmt::format(
        "format = \"frangia-rig\"\nversion = 1\n[camera]\nsize_px = [{}, {}]\nfocal_px = [450, "
        "450]\nprincipal_point_px = [120, 80]\n[projector]\nmodel = \"pinhole\"\nposition_mm = "
        "[200, 60, 0]\nrotation = [[{:.9f}, 0, {:.9f}], [0, 1, 0], [{:.9f}, 0, {:.9f}]]\nsize_px = "
        "[640, 480]\nfocal_px = [900, 900]\nprincipal_point_px = [320, 350]\n",
        kCameraWidth,
        kCameraHeight,
        std::cos(angle),
        std::sin(angle),
        -std::sin(angle),
        std::cos(angle));
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "scan"; }
  [[nodiscard]] std::string mesh() const { return (folder_.path() / "mesh.ply").string(); }
  [[nodiscard]] std::string stages() const { return (folder_.path() / "stages").string(); }
  [[nodiscard]] Answer reconstruct(const std::string& options = "") const {
    return run_program("--json reconstruct " + path().string() + " -o " + mesh() + " " + options +
                       " 2>&1");
  }

 private:
  static double turn() { return std::atan2(200.0, 500.0); }

  void write_frame(const std::string& name,
                   int frame,
                   bool columns,
                   double period,
                   double shift,
                   bool mirrored) {
    std::normal_distribution<double> noise(0.0, 1.0);
    Image<std::uint8_t> image(kCameraWidth, kCameraHeight);
    const double c = std::cos(turn());
    const double s = std::sin(turn());
    for (int y = 0; y < kCameraHeight; ++y) {
      for (int x = 0; x < kCameraWidth; ++x) {
        const double z = 500.0 + 6.0 * std::sin(0.05 * x) * std::cos(0.06 * y);
        const double px = z * (x - 120.0) / 450.0 - 200.0;
        const double py = z * (y - 80.0) / 450.0 - 60.0;
        const double depth = -s * px + c * z;
        double column = 320.0 + 900.0 * (c * px + s * z) / depth;
        const double row = 350.0 + 900.0 * py / depth;
        if (mirrored) column = 639.0 - column;
        const double phase = 360.0 * kDegree * (columns ? column : row) / period;
        image(x, y) = static_cast<std::uint8_t>(
            std::lround(120.0 + 90.0 * std::cos(phase + shift) + noise(generator_)));
      }
    }
    write_png(path() / "views/000" / fmt::format("{}-{}.png", name, frame), image);
  }

  TemporaryFolder folder_;
  std::mt19937 generator_{5};
};

TEST(InconsistentProgram, ReconstructsBothDirectionsAndReportsHowFarTheyAreApart) {
  const BumpyWall scan;
  const Answer answer = scan.reconstruct();
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto json = nlohmann::json::parse(answer.output.substr(answer.output.find("{\n")));
  EXPECT_LT(json["directions"]["disagreement_mm"], 0.3) << answer.output;
  EXPECT_NEAR(json["directions"]["over_noise"], 1.0, 0.3) << answer.output;
  const double fused = json["per_view"][0]["sigma_mm"];
  for (const std::string direction : {"vertical", "horizontal"}) {
    const Answer one = scan.reconstruct("--directions " + direction);
    ASSERT_EQ(one.exit_code, 0) << one.output;
    const auto of_one = nlohmann::json::parse(one.output.substr(one.output.find("{\n")));
    EXPECT_LT(fused, of_one["per_view"][0]["sigma_mm"]);
    EXPECT_FALSE(of_one.contains("directions"));
  }
}

TEST(InconsistentProgram, DoesNotUseADirectionWhosePatternsDisagree) {
  const BumpyWall scan({.pattern = "c80", .late_deg = 180.0});
  const Answer answer = scan.reconstruct();
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_NE(answer.output.find("\\\"c80\\\" fits a start of 180 degrees, not 0 degrees"),
            std::string::npos)
      << answer.output;
  EXPECT_NE(answer.output.find("this direction is not used"), std::string::npos) << answer.output;
}

TEST(InconsistentProgram, TriangulatesNothingThatDoesNotFitUnlessItIsAccepted) {
  const BumpyWall scan({.pattern = "c80", .late_deg = 180.0});
  const Answer answer = scan.reconstruct("--directions vertical");
  EXPECT_EQ(answer.exit_code, 5) << answer.output;
  EXPECT_NE(answer.output.find("\"c80\" fits a start of 180 degrees, not 0 degrees"),
            std::string::npos)
      << answer.output;
  EXPECT_NE(answer.output.find("--accept-inconsistent"), std::string::npos) << answer.output;
  EXPECT_FALSE(std::filesystem::exists(scan.mesh()));
  const Answer accepted = scan.reconstruct("--directions vertical --accept-inconsistent");
  EXPECT_EQ(accepted.exit_code, 0) << accepted.output;
  const Answer decoded = run_program("--json decode " + scan.path().string() + " -o " +
                                     scan.stages() + " --directions vertical 2>/dev/null");
  EXPECT_EQ(decoded.exit_code, 5) << decoded.output;
  EXPECT_NE(decoded.output.find("\"keys\": \"shifts_deg = [180, 270, 0, 90]\""), std::string::npos)
      << decoded.output;
}

TEST(InconsistentProgram, NamesAMirroredProjectorAndExchangedRows) {
  const Answer mirrored = BumpyWall({.mirrored = true}).reconstruct("--directions vertical");
  EXPECT_EQ(mirrored.exit_code, 5) << mirrored.output;
  EXPECT_NE(mirrored.output.find("mirrored left to right"), std::string::npos) << mirrored.output;
  const Answer exchanged = BumpyWall({.exchanged = true}).reconstruct();
  EXPECT_EQ(exchanged.exit_code, 5) << exchanged.output;
  EXPECT_NE(exchanged.output.find("direction = \"horizontal\" fits"), std::string::npos)
      << exchanged.output;
}

TEST(InconsistentProgram, DecodesPhasesWithoutARigAndSaysWhatAReconstructionNeeds) {
  const BumpyWall scan;
  for (const std::string rig :
       {"",
        "format = \"frangia-rig\"\nversion = 1\n[camera]\nsize_px = [240, 160]\nwhite_level = "
        "255\n"}) {
    std::filesystem::remove(scan.path() / "rig.toml");
    if (!rig.empty()) std::ofstream(scan.path() / "rig.toml") << rig;
    const Answer decoded = run_program("--json decode " + scan.path().string() + " -o " +
                                       scan.stages() + " 2>/dev/null");
    EXPECT_EQ(decoded.exit_code, 0) << decoded.output;
    EXPECT_NE(decoded.output.find("\"absolute.tiff\""), std::string::npos) << decoded.output;
    EXPECT_EQ(decoded.output.find("\"depth.tiff\""), std::string::npos) << decoded.output;
    const Answer refused = scan.reconstruct();
    EXPECT_EQ(refused.exit_code, 3) << refused.output;
    const std::string needs = rig.empty() ? "rig.toml: is missing; triangulation needs"
                                          : "camera.focal_px, camera.principal_point_px and "
                                            "[projector] are missing; triangulation needs";
    EXPECT_NE(refused.output.find(needs), std::string::npos) << refused.output;
  }
}

}  // namespace
}  // namespace frangia
