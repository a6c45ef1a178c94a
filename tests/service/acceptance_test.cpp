// The acceptance test of a scanner in the app: the artifact, an arrangement a project, the
// certificate.
#include <fstream>

#include <gtest/gtest.h>

#include "frangia/core/read_file.h"
#include "frangia/files/write_mesh.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

#include "service/service_fixture.h"

namespace frangia {
namespace {

using Json = nlohmann::json;

class AcceptanceInTheApp : public ServiceTest {
 protected:
  /// A project whose scan and surface are there: a ball bar with an error of its spacing.
  void put_bar(const std::string& name, double spacing_mm, const Json& summary = Json::object()) {
    const auto folder = folder_.path() / "projects" / name;
    std::filesystem::create_directories(folder / "scan" / "views" / "000");
    std::ofstream(folder / "project.json") << "{}";
    std::ofstream(folder / "scan" / "scan.toml")
        << "format = \"frangia-scan\"\nversion = 1\nname = \"bar\"\n[[pattern]]\nname = \"p20\"\n"
           "kind = \"fringe\"\nperiod_px = 20\nshifts_deg = [0, 120, 240]\n"
           "[[view]]\nangle_deg = 0\nfolder = \"views/000\"\n";
    std::ofstream(folder / "scan" / "views" / "000" / "p20-0.png") << name;
    write_rig(folder / "scan" / "rig.toml", rig_preset("digital"));
    write_mesh(folder / "surface.ply", make_dumbbell({20.0, 20.0}, spacing_mm));
    std::ofstream(folder / "surface.json") << summary.dump();
  }
  void open(const std::string& name) {
    static_cast<void>(command("open-project", {{"name", name}}));
    static_cast<void>(finish());
  }
  [[nodiscard]] Json test() const { return state().at("project").at("acceptance"); }

  const Json plan_ = {
      {"artifact", {{"diameters_mm", {20, 20}}, {"spacing_mm", 60}, {"u95_mm", 0.001}}},
      {"limits", {{"sphere_spacing_mm", 0.05}, {"probing_size_mm", nullptr}}},
      {"conditions", {{"operator", "Ä. \"M\""}, {"temperature_c", 20.5}}}};
};

TEST_F(AcceptanceInTheApp, MeasuresArrangementsOfASeriesAndCertifiesThem) {
  put_bar("bar", 60.0);
  open("bar");
  EXPECT_TRUE(test().is_null());
  EXPECT_NE(refusal("measure-arrangement", R"({"name": "upright"})"), "") << "no artifact";
  EXPECT_NE(refusal("certificate", "{}"), "");
  static_cast<void>(command("set-acceptance", {{"plan", plan_}}));
  EXPECT_EQ(test().at("operator"), "Ä. \"M\"");
  EXPECT_TRUE(test().at("verdict").is_null());
  EXPECT_NE(refusal("certificate", "{}"), "") << "nothing was measured";
  static_cast<void>(command("measure-arrangement", {{"name", "upright"}}));
  ASSERT_EQ(finish().at("state"), "done") << state().at("jobs").back().dump();
  EXPECT_EQ(test().at("verdict"), "in");

  // The next arrangement is a project of the series; its spacing is beyond the limit.
  static_cast<void>(command("next-part", {{"name", "bar 2"}}));
  static_cast<void>(finish());
  EXPECT_EQ(test().at("arrangements").size(), 1U) << "that of the project before";
  put_bar("bar 2", 60.2);
  restart();
  open("bar 2");
  static_cast<void>(command("measure-arrangement", {{"name", "level"}}));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_EQ(test().at("verdict"), "out");
  ASSERT_EQ(test().at("arrangements").size(), 2U);
  EXPECT_EQ(test().at("arrangements")[1].at("project"), "bar 2");
  const Json result = test();  // a loop over a part of what a call returns does not keep it
  for (const Json& quantity : result.at("quantities")) {
    if (quantity.at("symbol") != "SD") continue;
    EXPECT_NEAR(quantity.at("error_mm").get<double>(), 0.2, 1e-3);
    EXPECT_EQ(quantity.at("arrangement"), 1);
  }
  for (const char* format : {"html", "pdf"}) {
    static_cast<void>(command("certificate", {{"format", format}}));
    ASSERT_EQ(finish().at("state"), "done") << format;
  }
  const std::string page = read_text_file(service_->exported("bar 2 certificate.html").path);
  EXPECT_NE(page.find("The scanner exceeds its limits"), std::string::npos);
  EXPECT_NE(page.find("2: level"), std::string::npos);
  // Ended, nothing is left in this project; the one before keeps its arrangement.
  static_cast<void>(command("set-acceptance", {{"end", true}}));
  EXPECT_TRUE(test().is_null());
  open("bar");
  EXPECT_EQ(test().at("arrangements").size(), 1U);
}

TEST_F(AcceptanceInTheApp, RefusesAPlanWithAKeyOrArtifactThatIsWrong) {
  put_bar("bar", 60.0);
  open("bar");
  Json plan = plan_;
  plan["artifact"]["spacing_mm"] = 10;
  EXPECT_NE(refusal("set-acceptance", Json{{"plan", plan}}.dump()).find("would overlap"),
            std::string::npos);
  plan = plan_;
  plan["limits"]["size"] = 1;
  EXPECT_NE(refusal("set-acceptance", Json{{"plan", plan}}.dump()).find("limits.size"),
            std::string::npos);
  plan = plan_;
  plan["rig"] = "/etc/passwd";
  EXPECT_NE(refusal("set-acceptance", Json{{"plan", plan}}.dump()), "");
  EXPECT_NE(refusal("set-acceptance", R"({"plan": 3})"), "");
  EXPECT_TRUE(test().is_null());
}

TEST_F(AcceptanceInTheApp, RefusesASurfaceThatIsEditedOrNotTrustworthy) {
  put_bar("bar", 60.0, {{"untrusted_reason", "a frame was lost"}});
  open("bar");
  static_cast<void>(command("set-acceptance", {{"plan", plan_}}));
  static_cast<void>(command("measure-arrangement", {{"name", "upright"}}));
  const Json job = finish();
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_NE(job.at("error").get<std::string>().find("a frame was lost"), std::string::npos);
  EXPECT_TRUE(test().at("arrangements").empty());
  static_cast<void>(command("edit", {{"operation", "smooth"}, {"value", "1"}}));
  static_cast<void>(finish());
  EXPECT_NE(refusal("measure-arrangement", R"({"name": "upright"})").find("was edited"),
            std::string::npos);
}

TEST_F(AcceptanceInTheApp, TakesADamagedResultForNone) {
  put_bar("bar", 60.0);
  open("bar");
  static_cast<void>(command("set-acceptance", {{"plan", plan_}}));
  static_cast<void>(command("measure-arrangement", {{"name", "upright"}}));
  static_cast<void>(finish());
  std::ofstream(folder_.path() / "projects" / "bar" / "acceptance.json") << R"({"balls": [1]})";
  restart();
  open("bar");
  EXPECT_TRUE(test().at("arrangements").empty());
  std::ofstream(folder_.path() / "projects" / "bar" / "acceptance.toml") << "[[[";
  restart();
  open("bar");
  EXPECT_TRUE(test().is_null());
}

}  // namespace
}  // namespace frangia
