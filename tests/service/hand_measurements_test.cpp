#include "frangia/service/hand_measurements.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "service/service_fixture.h"

namespace frangia {
namespace {

using Json = nlohmann::json;

/// The box of `open_box` has sides at x = -5 and x = 5; of the latter, half is missing.
class HandMeasurements : public ServiceTest {
 protected:
  HandMeasurements() { open_box(60); }

  [[nodiscard]] Json project() const { return state().at("project"); }
  [[nodiscard]] std::string mesh() const { return project().at("surface").at("mesh"); }
  /// The place where a ray along x meets the surface.
  [[nodiscard]] Json place(double from_x, double y, bool face = false) const {
    const Json ray{{"eye", {from_x, y, 0.3}}, {"direction", {from_x > 0.0 ? -1.0 : 1.0, 0.0, 0.0}}};
    const Json hit = Json::parse(service_->pick(ray.dump())).at("hit");
    return {{"point_mm", hit.at("point_mm")}, {"triangle", hit.at("triangle")}, {"face", face}};
  }
  Json measure(const std::string& quantity, const Json& places) {
    static_cast<void>(
        command("measure", {{"quantity", quantity}, {"places", places}, {"mesh", mesh()}}));
    return finish();
  }
};

TEST_F(HandMeasurements, AreKeptWithTheProject) {
  EXPECT_EQ(measure("distance", {place(-9, 0.2), place(9, -4.2)}).at("state"), "done");
  EXPECT_EQ(measure("thickness", Json::array({place(-9, -4.2)})).at("state"), "done");
  EXPECT_EQ(measure("area", Json::array()).at("state"), "done");
  const Json list = project().at("measurements");
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].at("label"), "A");
  EXPECT_EQ(list[0].at("mesh"), mesh());
  EXPECT_NEAR(list[0].at("value").get<double>(), std::hypot(10.0, 4.4), 1e-5);
  EXPECT_TRUE(list[0].at("u95").is_null());
  EXPECT_EQ(list[1].at("label"), "B");
  EXPECT_NEAR(list[1].at("value").get<double>(), 10.0, 1e-5);
  EXPECT_EQ(list[2].at("unit"), "mm2");
  EXPECT_EQ(list[2].at("elements").at(0).at("kind"), "surface");
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_EQ(project().at("measurements"), list);
  static_cast<void>(command("remove-measurements", {{"labels", {"A", "Z"}}}));
  EXPECT_EQ(project().at("measurements").size(), 2U);
  EXPECT_EQ(measure("thickness", Json::array({place(9, -1.0)})).at("state"), "done");
  EXPECT_EQ(project().at("measurements").back().at("label"), "A");  // the first that is free
}

TEST_F(HandMeasurements, OfAFaceSayWhichShapeItIs) {
  EXPECT_EQ(measure("diameter", Json::array({place(40, 0.1, true)})).at("state"), "done");
  const Json ball = project().at("measurements").at(0);
  EXPECT_EQ(ball.at("elements").at(0).at("kind"), "sphere");
  EXPECT_NEAR(ball.at("value").get<double>(), 6.0, 0.15);
}

TEST_F(HandMeasurements, OfASurfaceThatHasChangedAreRefused) {
  const Json places{place(-9, 0.2), place(9, -4.2)};
  const std::string before = mesh();
  static_cast<void>(command("edit", {{"operation", "offset"}, {"value", "0.1mm"}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_NE(mesh(), before);
  static_cast<void>(
      command("measure", {{"quantity", "distance"}, {"places", places}, {"mesh", before}}));
  const Json job = finish();
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_NE(job.at("error").get<std::string>().find("has changed"), std::string::npos);
  EXPECT_TRUE(project().at("measurements").empty());
  static_cast<void>(command("undo"));
  static_cast<void>(finish());
  EXPECT_EQ(mesh(), before);
  static_cast<void>(command("edit", {{"operation", "invert"}, {"value", ""}}));
  static_cast<void>(finish());
  EXPECT_EQ(mesh(), before);  // a selection changes no mesh
}

TEST_F(HandMeasurements, RefuseWhatIsNone) {
  const Json one = place(9, -1.0);
  const auto refused = [&](const Json& arguments) { return refusal("measure", arguments.dump()); };
  EXPECT_NE(
      refused({{"quantity", "weight"}, {"places", Json::array()}, {"mesh", "1"}}).find("quantity"),
      std::string::npos);
  EXPECT_NE(refused({{"quantity", "area"}, {"places", 3}, {"mesh", "1"}}).find("list"),
            std::string::npos);
  EXPECT_NE(refused({{"quantity", "area"}, {"places", {one, one, one, one}}, {"mesh", "1"}})
                .find("at most 3"),
            std::string::npos);
  Json wrong = one;
  wrong["point_mm"] = {1.0, 2.0};
  EXPECT_NE(refused({{"quantity", "thickness"}, {"places", Json::array({wrong})}, {"mesh", "1"}})
                .find("point_mm"),
            std::string::npos);
  wrong = one;
  wrong["evil"] = 1;
  EXPECT_NE(refused({{"quantity", "thickness"}, {"places", Json::array({wrong})}, {"mesh", "1"}})
                .find("evil"),
            std::string::npos);
  EXPECT_NE(refusal("remove-measurements", R"({"labels": [3]})").find("labels"), std::string::npos);
  wrong = one;
  wrong["triangle"] = 4'000'000;
  EXPECT_EQ(measure("thickness", Json::array({wrong})).at("state"), "failed");
}

TEST_F(HandMeasurements, OfAnOlderProgramAreReadAndDamagedOnesAreNot) {
  const auto file = folder_.path() / "projects" / "box" / "measurements.json";
  std::ofstream(file) << R"({"format": "frangia-measurements", "version": 1, "measurements": [
    {"label": "C", "mesh": "1-2a", "points_mm": [[0, 0.5, 1], [3, 0.5, 5]], "sigmas_mm": [0.01, null]}]})";
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  ASSERT_EQ(project().at("measurements").size(), 1U);
  EXPECT_NEAR(project().at("measurements").at(0).at("value").get<double>(), 5.0, 1e-9);
  std::ofstream(file) << "{\"measurements\": 3";
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_TRUE(project().at("measurements").empty());
}

TEST_F(HandMeasurements, BesideThemAPlaneCutsTheSurface) {
  const auto section = [&](const Json& point, const Json& normal) {
    return Json::parse(service_->section(Json{{"point_mm", point}, {"normal", normal}}.dump()));
  };
  const Json ball = section({20, 0, 0}, {1, 0, 0});
  ASSERT_EQ(ball.at("curves").size(), 1U);
  EXPECT_TRUE(ball.at("curves").at(0).at("closed").get<bool>());
  EXPECT_NEAR(ball.at("area_mm2").get<double>(), 3.1416 * 9.0, 1.5);
  EXPECT_NEAR(ball.at("length_mm").get<double>(), 2.0 * 3.1416 * 3.0, 0.5);
  EXPECT_TRUE(section({90, 0, 0}, {1, 0, 0}).at("curves").empty());
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(section({0, 0, 0}, {0, 0, 0}));
            }).find("normal"),
            std::string::npos);
  static_cast<void>(command("export-section",
                            {{"point_mm", {20, 0, 0}}, {"normal", {1, 0, 0}}, {"format", "dxf"}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(project().at("exports").at(0).at("name"), "box section.dxf");
  static_cast<void>(command("export-section",
                            {{"point_mm", {90, 0, 0}}, {"normal", {1, 0, 0}}, {"format", "svg"}}));
  EXPECT_NE(finish().at("error").get<std::string>().find("does not meet"), std::string::npos);
}

}  // namespace
}  // namespace frangia
