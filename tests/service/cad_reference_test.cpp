// A CAD reference in the app. Left out of a build without OpenCASCADE.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/read_file.h"

#include "service/service_fixture.h"

namespace frangia {
namespace {

using Json = nlohmann::json;

TEST_F(ServiceTest, NamesTheFaceOfACadReferenceThatIsPicked) {
  open_box();
  const std::string bytes = read_text_file(std::filesystem::path(FRANGIA_SOURCE_DIR) /
                                           "tests/data/cad-samples/plate.stp");
  service_->add_to_reference(0, bytes);
  static_cast<void>(command("set-reference",
                            {{"name", "plate.stp"}, {"format", "stp"}, {"bytes", bytes.size()}}));
  static_cast<void>(finish());
  static_cast<void>(command("show-reference"));
  EXPECT_EQ(finish().at("state"), "done");
  const auto face = [&](const Json& eye, const Json& direction) {
    const Json ray{{"eye", eye}, {"direction", direction}, {"reference", true}};
    return Json::parse(service_->pick(ray.dump())).at("hit").at("face");
  };
  const Json bore = face({0, 1, 5}, {1, 0, 0});
  EXPECT_EQ(bore.at("kind"), "cylinder");
  EXPECT_NEAR(bore.at("diameter_mm").get<double>(), 16.0, 1e-6);
  EXPECT_EQ(face({0, 1, 4}, {-1, 0, 0}), bore);
  const Json top = face({20, 5, 50}, {0, 0, -1});
  EXPECT_EQ(top.at("kind"), "plane");
  EXPECT_TRUE(top.at("diameter_mm").is_null());
  EXPECT_NE(face({20, 5, -50}, {0, 0, 1}).at("number"), top.at("number"));
  // As inspection.toml numbers it.
  const Json features{{{"name", "bore"}, {"face", bore.at("number")}}};
  static_cast<void>(command("set-plan", {{"plan", {{"align", "none"}, {"features", features}}}}));
  EXPECT_EQ(state().at("project").at("plan").at("features")[0].at("face"), bore.at("number"));
}

}  // namespace
}  // namespace frangia
