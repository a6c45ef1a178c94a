// The verb decode: the phase maps of all views, which `reconstruct --phase` reads back.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using Json = nlohmann::json;
using testing::Answer;
using testing::run_program;

class DecodeProgram : public ::testing::Test {
 protected:
  void simulate(const std::string& part, int views, int divisor = 2) const {
    static_cast<void>(testing::small_scan(
        folder_.path() / "scan", part, "digital", views, {.samples_per_px = 4}, divisor));
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }
  /// The JSON that the program prints.
  static Json json_of(const std::string& arguments, int exit_code = 0) {
    const Answer answer = run_program("--json " + arguments + " 2>/dev/null");
    EXPECT_EQ(answer.exit_code, exit_code) << answer.output;
    return Json::parse(answer.output);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(DecodeProgram, WritesMapsOfAllViewsThatGiveTheSameSurface) {
  simulate("bracket", 3);
  const Answer answer = run_program("decode " + path("scan") + " -o " + path("maps"));
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  for (const char* line :
       {"\n001   120.00 deg", "\n002   240.00 deg", "\nwrote the maps of 3 views"})
    EXPECT_NE(("\n" + answer.output).find(line), std::string::npos) << answer.output;
  for (const char* view : {"000", "001", "002"}) {
    for (const char* map :
         {"p20-phase.tiff", "p20-sigma.tiff", "depth.tiff", "depth-sigma.tiff", "mask.png"})
      EXPECT_TRUE(exists(std::string("maps/") + view + "/" + map)) << view << map;
  }
  const Json own = json_of("reconstruct " + path("scan") + " -o " + path("a.ply"));
  const Json back =
      json_of("reconstruct " + path("scan") + " --phase " + path("maps") + " -o " + path("b.ply"));
  ASSERT_GT(own["points"], 10000);
  EXPECT_NEAR(back["points"].get<double>(),
              own["points"].get<double>(),
              0.01 * own["points"].get<double>());
  EXPECT_NEAR(back["median_sigma"]["combined_mm"].get<double>(),
              own["median_sigma"]["combined_mm"].get<double>(),
              0.02 * own["median_sigma"]["combined_mm"].get<double>());
}

TEST_F(DecodeProgram, GivesTheFiguresOfEachViewInJson) {
  simulate("plate", 2);
  const Json all = json_of("decode " + path("scan") + " -o " + path("maps"));
  ASSERT_EQ(all["views"].size(), 2U);
  EXPECT_EQ(all["trustworthy"], true);
  const Json one = json_of("decode " + path("scan") + " --view 1 -o " + path("stages"));
  for (const char* key : {"view", "angle_deg", "contrast", "saturated_share", "points", "pixels"})
    EXPECT_EQ(all["views"][1][key], one[key]) << key;
  EXPECT_EQ(one["view"], 1);
  EXPECT_EQ(one["quality"], "good");
  EXPECT_NEAR(one["contrast"], 0.9, 0.02);  // of the full camera; half its pixels blur fine fringes
  EXPECT_NEAR(one["residual_ratio"], 1.0, 0.1);
  EXPECT_TRUE(exists("stages/index.html"));
  EXPECT_FALSE(exists("stages/000"));
}

TEST_F(DecodeProgram, ShowsWhereFringeOrdersComeFrom) {
  simulate("plate", 1, 4);
  const std::string text =
      "vertical fringes of 1280, 160 and 20 px: each map gives the orders of the next finer one, "
      "from one fringe over the field on";
  const Answer answer = run_program("decode " + path("scan") + " --show-plan");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.output, text + "\n");
  const Json alone = json_of("decode " + path("scan") + " --show-plan");
  EXPECT_EQ(alone["absolute"], true);
  EXPECT_EQ(alone["plan"],
            Json::parse(R"([{"direction": "vertical", "maps": ["p1280", "p160", "p20"],
                             "orders": "coarser-maps", "text": ")" +
                        text + "\"}]"));
  EXPECT_EQ(json_of("decode " + path("scan") + " -o " + path("stages"))["plan"], alone["plan"]);
  EXPECT_EQ(run_program("decode " + path("scan") + " 2>&1").exit_code, 2);
}

TEST_F(DecodeProgram, PrintsTheTablesOfHypothesesThatTheDocsShow) {
  const Answer answer = run_program("decode --show-hypotheses");
  EXPECT_EQ(answer.exit_code, 0);
  std::ifstream in(std::string(FRANGIA_SOURCE_DIR) + "/docs/phase.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const auto between = [&](const std::string& begin, const std::string& end) {
    const auto from = page.find(begin) + begin.size();
    return page.substr(from, page.find(end) - from);
  };
  EXPECT_EQ(answer.output,
            between("<!-- hypotheses -->\n", "<!-- end of hypotheses -->") + "\n" +
                between("<!-- classes -->\n", "<!-- end of classes -->"));
  EXPECT_EQ(run_program("decode " + path("scan") + " --show-hypotheses 2>&1").exit_code, 2);
  EXPECT_EQ(run_program("decode 2>&1").exit_code, 2);
}

TEST_F(DecodeProgram, WritesStagesAndMapsOfAScanOfOneView) {
  simulate("plate", 1, 4);
  const Json one = json_of("decode " + path("scan") + " -o " + path("stages"));
  EXPECT_EQ(one["view"], 0);
  EXPECT_TRUE(exists("stages/index.html"));
  EXPECT_TRUE(exists("stages/depth.tiff"));
  const Json back = json_of("reconstruct " + path("scan") + " --phase " + path("stages") + " -o " +
                            path("b.ply"));
  EXPECT_NEAR(back["points"].get<double>(),
              one["points"].get<double>(),
              0.01 * one["points"].get<double>());
}

TEST_F(DecodeProgram, NamesTheViewThatDoesNotFitAndDecodesTheOthers) {
  simulate("plate", 2);
  for (const char* pattern : {"p1280", "p160", "p20"}) {  // shifts in the opposite direction
    const auto view = folder_.path() / "scan/views/1";
    const auto file = [&](int frame) {
      return view / (std::string(pattern) + "-" + std::to_string(frame) + ".png");
    };
    ASSERT_TRUE(std::filesystem::exists(file(1))) << file(1);
    std::filesystem::rename(file(1), view / "kept.png");
    std::filesystem::rename(file(3), file(1));
    std::filesystem::rename(view / "kept.png", file(3));
  }
  const Json all = json_of("decode " + path("scan") + " -o " + path("maps"), 5);
  EXPECT_EQ(all["trustworthy"], false);
  EXPECT_NE(all["reason"].get<std::string>().find("views/1: "), std::string::npos) << all["reason"];
  EXPECT_EQ(all["views"][0]["quality"], "good");
  EXPECT_EQ(all["views"][1]["quality"], "rejected");
  EXPECT_TRUE(all["views"][1]["points"].is_null());
  EXPECT_TRUE(exists("maps/001/p20-phase.tiff"));
  EXPECT_FALSE(exists("maps/001/depth.tiff"));
}

}  // namespace
}  // namespace frangia
