#include "service/live_service.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

using testing::error_of;
using testing::Json;
using testing::LiveServiceTest;

TEST_F(LiveServiceTest, DecodesFramesAsTheyComeAndFollowsTheSettings) {
  EXPECT_NE(error_of([&] { command("set-live", {{"pattern", "white"}}); }), "") << "none runs";
  command("start-live");
  const Json decoded = header(
      LiveLayer::Depth, [](const Json& values) { return values.at("points").get<int>() > 0; });
  const Json& values = decoded.at("values");
  EXPECT_EQ(values.at("layer"), "depth");
  EXPECT_EQ(length_of(decoded, "picture"), 640U * 512U);
  EXPECT_EQ(length_of(decoded, "histogram"), 64U);
  EXPECT_GT(values.at("points").get<int>(), 5000);
  EXPECT_GT(values.at("contrast").get<double>(), 0.5);
  EXPECT_LT(values.at("low").get<double>(), values.at("high").get<double>());
  const auto any = [](const Json&) { return true; };
  EXPECT_GT(length_of(header(LiveLayer::Points, any), "positions"), 15'000U);
  for (const LiveLayer layer : {LiveLayer::Phase, LiveLayer::Modulation, LiveLayer::Status})
    EXPECT_EQ(length_of(header(layer, any), "picture"), 640U * 512U);

  command("set-capture", {{"exposure_ms", 80.0}});
  static_cast<void>(header(
      LiveLayer::Camera, [](const Json& now) { return now.at("saturated").get<double>() > 0.02; }));
  command("set-live", {{"pattern", "dark"}});
  static_cast<void>(header(LiveLayer::Camera, [](const Json& now) {
    return now.at("dark").get<double>() > 0.5 && now.at("saturated").get<double>() == 0.0;
  }));
  EXPECT_EQ(project().at("live").at("pattern"), "dark");
  EXPECT_EQ(project().at("capture").at("exposure_ms"), 80.0);
  EXPECT_NE(error_of([&] { command("set-capture", {{"shifts", 2}}); }), "");
  EXPECT_NE(error_of([&] { command("set-capture", {{"algorithm", "magic"}}); }), "");

  command("test-devices");  // the preview gives way
  EXPECT_TRUE(wait([&] { return !busy(); }));
  EXPECT_TRUE(project().at("live").is_null());
  const Json devices = project().at("devices");
  ASSERT_EQ(devices.size(), 3U);
  for (const Json& device : devices)
    EXPECT_NE(device.at("answer"), "") << device;
}

TEST_F(LiveServiceTest, MovesTheRigUntilTheScanBegins) {
  const double distance = project().at("rig").at("turntable").at("distance_mm").get<double>();
  command("set-rig", {{"distance_mm", distance + 20.0}});
  EXPECT_NEAR(
      project().at("rig").at("turntable").at("distance_mm").get<double>(), distance + 20.0, 1e-6);
  const Rig known = read_rig(folder_.path() / "live" / "rig.toml");
  const Rig truth = read_rig(folder_.path() / "live" / "true-rig.toml");
  EXPECT_NEAR((known.projector.rotation - truth.projector.rotation).norm(), 0.0, 1e-9);
  EXPECT_NE(error_of([&] { command("set-rig", {{"distance_mm", -1.0}}); }), "");
}

}  // namespace
}  // namespace frangia
