#include "frangia/service/hand_measurements.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "service/service_fixture.h"

namespace frangia {
namespace {

using Json = nlohmann::json;

Json distance(const std::string& label) {
  return {{"label", label},
          {"mesh", "1-2a"},
          {"points_mm", {{0.0, 0.5, 1.0}, {3.0, 0.5, 5.0}}},
          {"sigmas_mm", {0.01, nullptr}}};
}

TEST_F(ServiceTest, KeepsWhatWasMeasuredByHandWithTheProject) {
  open_box();
  const Json list{distance("A"), distance("B")};
  static_cast<void>(command("set-measurements", {{"measurements", list}}));
  EXPECT_EQ(state().at("project").at("measurements"), list);
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("measurements"), list);
  static_cast<void>(command("set-measurements", {{"measurements", Json::array()}}));
  EXPECT_TRUE(state().at("project").at("measurements").empty());
}

TEST_F(ServiceTest, RefusesMeasurementsThatAreNoneAndKeepsThoseBefore) {
  open_box();
  const Json list{distance("A")};
  static_cast<void>(command("set-measurements", {{"measurements", list}}));
  const auto refused = [&](const char* key, const Json& value) {
    Json wrong = distance("B");
    wrong[key] = value;
    return refusal("set-measurements", Json{{"measurements", {wrong}}}.dump());
  };
  EXPECT_NE(refused("label", "").find("label"), std::string::npos);
  EXPECT_NE(refused("mesh", 3).find("mesh"), std::string::npos);
  EXPECT_NE(refused("points_mm", {{0.0, 0.0, 0.0}}).find("two or three"), std::string::npos);
  EXPECT_NE(refused("points_mm", {{0.0, 0.0}, {1.0, 1.0}}).find("three coordinates"),
            std::string::npos);
  EXPECT_NE(refused("sigmas_mm", {-1.0, 0.0}).find("0 or more"), std::string::npos);
  EXPECT_NE(refused("sigmas_mm", {1e9, 0.0}).find("at most 1e7"), std::string::npos);
  const Json twice{{"measurements", {distance("A"), distance("A")}}};
  EXPECT_NE(refusal("set-measurements", twice.dump()).find("label A"), std::string::npos);
  EXPECT_EQ(state().at("project").at("measurements"), list);
}

TEST_F(ServiceTest, OpensAProjectWhoseMeasurementsAreDamaged) {
  open_box();
  std::ofstream(folder_.path() / "projects" / "box" / "measurements.json")
      << "{\"measurements\": 3";
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_TRUE(state().at("project").at("measurements").empty());
}

}  // namespace
}  // namespace frangia
