// The surface inspected in the app: a reference that arrives, a plan that the page makes, and the
// reports.
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "frangia/core/read_file.h"
#include "frangia/files/write_mesh.h"

#include "service/service_fixture.h"

namespace frangia {
namespace {

using testing::error_of;
using Json = nlohmann::json;

TEST_F(ServiceTest, ComparesTheSurfaceWithAReferenceThatArrivesInPieces) {
  open_box();
  EXPECT_NE(refusal("inspect", "{}"), "") << "there is no reference";
  const auto file = folder_.path() / "nominal.stl";
  Mesh nominal = testing::sphere({20, 0, 0}, 3.0, 12);
  append_mesh(nominal, testing::box({-5, -5, -5}, {5, 5, 4.75}));  // 0.25 mm lower than measured
  write_mesh(file, nominal);
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t half = bytes.size() / 2;
  service_->add_to_reference(0, bytes.substr(0, half));
  EXPECT_NE(error_of([&] { service_->add_to_reference(half + 1, "x"); }), "") << "a gap";
  EXPECT_NE(error_of([&] { service_->add_to_reference(600'000'000, "x"); }), "") << "too large";
  Json asked = {{"name", "nominal.stl"}, {"format", "stl"}, {"bytes", bytes.size()}};
  EXPECT_NE(refusal("set-reference", asked.dump()), "") << "it is incomplete";
  service_->add_to_reference(half, bytes.substr(half));
  asked["format"] = "../stl";
  EXPECT_NE(refusal("set-reference", asked.dump()), "");
  asked["format"] = "stl";
  static_cast<void>(command("set-reference", asked));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_NE(refusal("set-plan", R"({"plan": {"tolerance_mm": [1, 0]}})"), "");
  static_cast<void>(
      command("set-plan", {{"plan", {{"align", "none"}, {"tolerance_mm", {-0.1, 0.2}}}}}));
  static_cast<void>(command("inspect"));
  ASSERT_EQ(finish().at("state"), "done");
  const Json found = state().at("project").at("surface").at("comparison");
  EXPECT_EQ(found.at("reference"), "nominal.stl");
  EXPECT_EQ(found.at("tolerance_mm"), Json::array({-0.1, 0.2}));
  EXPECT_NEAR(found.at("max_mm").get<double>(), 0.25, 1e-6);
  EXPECT_EQ(found.at("verdict"), "out");
  const Json inspection = state().at("project").at("surface").at("inspection");
  EXPECT_EQ(inspection.at("verdict"), "out");
  ASSERT_FALSE(inspection.at("places").empty());
  EXPECT_EQ(inspection.at("places")[0].at("decision"), "out");
  EXPECT_FALSE(service_->deviations(0).empty());
  EXPECT_TRUE(service_->deviations(1).empty());
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("reference").at("name"), "nominal.stl");
}

TEST_F(ServiceTest, InspectsByAPlanThatThePageMakesAndTheFolderKeeps) {
  open_box();
  EXPECT_TRUE(state().at("project").at("plan").is_null());
  const Json top = {{"name", "top \"A\""}, {"kind", "plane"}, {"near_mm", {0, 0, 5}}};
  Json bottom = {{"name", "bottom"}, {"kind", "plane"}, {"near_mm", {0, 0, -5}}};
  const Json height = {{"name", "height"},
                       {"kind", "distance"},
                       {"feature", "top \"A\""},
                       {"datum", "bottom"},
                       {"nominal", 10},
                       {"tolerance", {-0.01, 0.01}}};
  Json plan = {{"part", "box ä"},
               {"features", {top, bottom}},
               {"characteristics", {height}},
               {"reference", "/etc/passwd"},
               {"report", {{"serial", "17"}, {"logo", "/etc/passwd"}}}};
  static_cast<void>(command("set-plan", {{"plan", plan}}));
  Json kept = state().at("project").at("plan");
  EXPECT_EQ(kept.at("features").size(), 2U);
  EXPECT_EQ(kept.at("report"), Json({{"serial", "17"}})) << "no file that a page names is opened";
  EXPECT_FALSE(kept.contains("reference"));
  bottom["kinds"] = "plane";
  const auto wrong = refusal("set-plan", Json{{"plan", {{"features", {top, bottom}}}}}.dump());
  EXPECT_NE(wrong.find("the plan: \"bottom\": features[1].kinds is unknown here"),
            std::string::npos)
      << wrong;
  EXPECT_EQ(state().at("project").at("plan"), kept) << "a plan that is refused changes nothing";

  static_cast<void>(command("inspect", {{"features", true}}));
  ASSERT_EQ(finish().at("state"), "done");
  const Json found = state().at("project").at("surface").at("inspection");
  ASSERT_EQ(found.at("characteristics").size(), 1U);
  EXPECT_NEAR(found.at("characteristics")[0].at("value").get<double>(), 10.0, 1e-4);
  EXPECT_EQ(found.at("verdict"), "in");
  EXPECT_TRUE(state().at("project").at("surface").at("comparison").is_null());
  std::size_t named = 0;
  for (const Json& feature : found.at("features"))
    named += feature.at("name").is_null() ? 0U : 1U;
  EXPECT_EQ(named, 2U);

  for (const char* format : {"html", "pdf", "csv", "qif", "toml"}) {
    static_cast<void>(command("report", {{"format", format}}));
    EXPECT_EQ(finish().at("state"), "done") << format;
  }
  const auto text = [&](const char* name) { return read_text_file(service_->exported(name).path); };
  EXPECT_NE(text("box report.html").find("box ä"), std::string::npos);
  EXPECT_NE(text("box report.pdf").find("box ä"), std::string::npos) << "the page is printed";
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "projects" / "box" / "report.part.html"));
  EXPECT_NE(text("box report.csv").find("\"height\",mm,10,9.99,10.01,10,"), std::string::npos);
  EXPECT_NE(text("inspection.toml").find("name = \"height\""), std::string::npos);
  // The plan that was saved is read back, and the one in the folder after a restart.
  const std::string saved = text("inspection.toml");
  static_cast<void>(command("set-plan", {{"plan", {{"part", "other"}}}}));
  static_cast<void>(command("open-plan", {{"text", saved}}));
  EXPECT_EQ(state().at("project").at("plan"), kept);
  EXPECT_NE(refusal("open-plan", R"({"text": "part = 1"})"), "");
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("plan"), kept);
  std::ofstream(folder_.path() / "projects" / "box" / "inspection.toml") << "format = 1\n";
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_TRUE(state().at("project").at("plan").is_null());
  EXPECT_NE(state().at("project").at("plan_fault"), "");
}

TEST_F(ServiceTest, SaysThatResultsAreOfAnotherPlanThanThePresentOne) {
  open_box();
  const auto is_current = [&] {
    return state().at("project").at("surface").at("inspection").at("current").get<bool>();
  };
  const Json top = {{"name", "top"}, {"kind", "plane"}, {"near_mm", {0, 0, 5}}};
  const Json other = {
      {"name", "other"}, {"kind", "torus"}, {"near_mm", {0, 0, 0}}, {"diameter_mm", 1}};
  static_cast<void>(command("set-plan", {{"plan", {{"features", {top, other}}}}}));
  static_cast<void>(command("inspect"));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_TRUE(is_current());
  const Json warnings = state().at("project").at("surface").at("inspection").at("warnings");
  EXPECT_NE(warnings.dump().find("other: no torus was found"), std::string::npos) << warnings;
  Json plan = state().at("project").at("plan");
  plan["part"] = "box";
  plan["report"] = {{"serial", "17"}};
  static_cast<void>(command("set-plan", {{"plan", plan}}));
  EXPECT_TRUE(is_current()) << "the head of the report changes nothing that was measured";

  // A plan by which nothing can be inspected leaves the results of the plan before.
  plan["characteristics"] = {{{"name", "wrong"}, {"kind", "roundness"}, {"feature", "top"}}};
  static_cast<void>(command("set-plan", {{"plan", plan}}));
  static_cast<void>(command("inspect"));
  EXPECT_EQ(finish().at("state"), "failed");
  EXPECT_FALSE(is_current());
  EXPECT_NE(refusal("report", R"({"format": "html"})").find("inspect again"), std::string::npos);
  static_cast<void>(command("report", {{"format", "toml"}}));
  EXPECT_EQ(finish().at("state"), "done") << "the plan can be saved";
  plan.erase("characteristics");
  static_cast<void>(command("set-plan", {{"plan", plan}}));
  EXPECT_TRUE(is_current());

  const auto file = folder_.path() / "nominal.stl";
  write_mesh(file, testing::box({-5, -5, -5}, {5, 5, 5}));
  const std::string bytes = read_text_file(file);
  service_->add_to_reference(0, bytes);
  static_cast<void>(command("set-reference",
                            {{"name", "nominal.stl"}, {"format", "stl"}, {"bytes", bytes.size()}}));
  static_cast<void>(finish());
  EXPECT_FALSE(is_current()) << "nothing was compared with the reference yet";
}

TEST_F(ServiceTest, InspectsTheNextPartByTheSamePlan) {
  open_box(60);
  const Json side = {{"name", "ball"},
                     {"kind", "sphere"},
                     {"near_mm", {20, 0, 0}},
                     {"diameter_mm", 6},
                     {"tolerance_mm", {-0.2, 0.2}}};
  static_cast<void>(command("set-plan", {{"plan", {{"features", Json::array({side})}}}}));
  static_cast<void>(command("inspect"));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_TRUE(state().at("project").at("series").empty());
  Json plan = state().at("project").at("plan");
  plan["report"] = {{"serial", "No. 1"}};
  static_cast<void>(command("set-plan", {{"plan", plan}}));
  EXPECT_NE(refusal("next-part", R"({"name": "box"})"), "") << "the name is taken";
  EXPECT_NE(refusal("next-part", R"({"name": "../evil"})"), "");
  static_cast<void>(command("next-part", {{"name", "box 2"}}));
  static_cast<void>(finish());
  const Json next = state().at("project");
  EXPECT_EQ(next.at("name"), "box 2");
  EXPECT_EQ(next.at("plan").at("features").size(), 1U);
  EXPECT_FALSE(next.at("plan").contains("report")) << "the serial number is of the part before";
  ASSERT_EQ(next.at("series").size(), 1U);
  const Json before = next.at("series")[0];
  EXPECT_EQ(before.at("name"), "box");
  EXPECT_EQ(before.at("serial"), "No. 1");
  EXPECT_EQ(before.at("verdict"), "in");
  ASSERT_EQ(before.at("rows").size(), 1U);
  EXPECT_NEAR(before.at("rows")[0].at("value").get<double>(), 6.0, 0.2);
  EXPECT_EQ(before.at("rows")[0].at("verdict"), "in");

  // The third part knows both; results that are damaged are none, a project that is gone is none.
  static_cast<void>(command("next-part", {{"name", "box 3"}}));
  static_cast<void>(finish());
  const Json series = state().at("project").at("series");
  ASSERT_EQ(series.size(), 2U);
  EXPECT_TRUE(series[1].at("verdict").is_null()) << "the second was not inspected";
  std::ofstream(folder_.path() / "projects" / "box" / "results.json") << "{";
  static_cast<void>(command("discard-project", {{"name", "box 2"}}));
  restart();
  static_cast<void>(command("open-project", {{"name", "box 3"}}));
  static_cast<void>(finish());
  const Json left = state().at("project").at("series");
  ASSERT_EQ(left.size(), 1U);
  EXPECT_TRUE(left[0].at("verdict").is_null());
}

TEST_F(ServiceTest, AlignsByPlacesThatArePickedOnSurfaceAndReference) {
  open_box();
  const auto file = folder_.path() / "moved.stl";
  Mesh nominal = testing::sphere({20, 0, 0}, 3.0, 12);
  append_mesh(nominal, testing::box({-5, -5, -5}, {5, 5, 5}));
  for (Eigen::Vector3f& vertex : nominal.vertices_mm)
    vertex += Eigen::Vector3f(100.0F, 0.0F, 0.0F);
  write_mesh(file, nominal);
  const std::string bytes = read_text_file(file);
  EXPECT_NE(refusal("show-reference", "{}").find("no reference"), std::string::npos);
  service_->add_to_reference(0, bytes);
  static_cast<void>(command("set-reference",
                            {{"name", "moved.stl"}, {"format", "stl"}, {"bytes", bytes.size()}}));
  static_cast<void>(finish());
  const auto shown = [&] { return state().at("project").at("reference").at("shown"); };
  EXPECT_EQ(shown(), false);
  EXPECT_TRUE(service_->reference_picture().empty());
  Json ray{{"eye", {190, 0.5, 0.3}}, {"direction", {-1, 0, 0}}, {"reference", true}};
  EXPECT_NE(error_of([&] { static_cast<void>(service_->pick(ray.dump())); }).find("show it first"),
            std::string::npos);
  static_cast<void>(command("show-reference"));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(shown(), true);
  EXPECT_FALSE(service_->reference_picture().empty());

  // Rays through the ball and two sides of the box, on the surface and on the reference.
  Json points = Json::array();
  const std::vector<std::pair<Json, Json>> rays{
      {{90, 0.5, 0.3}, {-1, 0, 0}}, {{1, 2, 50}, {0, 0, -1}}, {{-3, 50, 1}, {0, -1, 0}}};
  for (const auto& [eye, direction] : rays) {
    const auto picked = [&](double moved, bool reference) {
      Json from = eye;
      from[0] = from[0].get<double>() + moved;
      const Json asked{{"eye", from}, {"direction", direction}, {"reference", reference}};
      return Json::parse(service_->pick(asked.dump())).at("hit").at("point_mm");
    };
    points.push_back({{"scan_mm", picked(0.0, false)}, {"reference_mm", picked(100.0, true)}});
  }
  static_cast<void>(command("set-plan", {{"plan", {{"align", "points"}, {"points", points}}}}));
  EXPECT_EQ(state().at("project").at("plan").at("points").size(), 3U);
  static_cast<void>(command("inspect"));
  const Json job = finish();
  ASSERT_EQ(job.at("state"), "done") << job.at("error");
  const Json found = state().at("project").at("surface");
  EXPECT_NEAR(found.at("comparison").at("moved_mm").get<double>(), 100.0, 1e-3);
  EXPECT_NEAR(found.at("comparison").at("max_mm").get<double>(), 0.0, 1e-3);
  EXPECT_FALSE(found.at("inspection").at("reasons").empty());
  // Another reference is not the one that is shown.
  service_->add_to_reference(0, bytes);
  static_cast<void>(command("set-reference",
                            {{"name", "other.stl"}, {"format", "stl"}, {"bytes", bytes.size()}}));
  static_cast<void>(finish());
  EXPECT_EQ(shown(), false);
}

}  // namespace
}  // namespace frangia
