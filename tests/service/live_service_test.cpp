#include "service/live_service.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/devices/device_settings.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/small_scan.h"
#include "support/text_of.h"

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

TEST_F(LiveServiceTest, FindsTheExposureAndThePreviewReturns) {
  command("start-live");
  static_cast<void>(header(LiveLayer::Camera, [](const Json&) { return true; }));
  const auto exposure_ms = [&] { return project().at("capture").at("exposure_ms").get<double>(); };
  command("set-capture", {{"exposure_ms", 2.0}});
  command("find-exposure");
  ASSERT_TRUE(wait([&] { return exposure_ms() != 2.0; })) << service_.state();
  const double found_ms = exposure_ms();
  EXPECT_GT(found_ms, 4.0);
  const auto saturated = [&](double at_ms) {
    command("set-capture", {{"exposure_ms", at_ms}});
    command("set-live", {{"pattern", "fringes"}});
    for (int i = 0; i < 12; ++i)  // the frames of all patterns
      static_cast<void>(header(LiveLayer::Camera, [](const Json&) { return true; }));
    double most = 0.0;
    for (int i = 0; i < 12; ++i) {
      const Json seen = header(LiveLayer::Camera, [](const Json&) { return true; });
      most = std::max(most, seen.at("values").at("saturated").get<double>());
    }
    return most;
  };
  ASSERT_TRUE(wait([&] { return !project().at("live").is_null(); })) << "the preview returns";
  EXPECT_LT(saturated(found_ms), 0.005);
  EXPECT_GT(saturated(2.0 * found_ms), 0.005);
}

TEST_F(LiveServiceTest, FindsSeveralExposuresForAGlossyPart) {
  command("create-project", {{"name", "glossy"}, {"part", "bust"}, {"stations", 2}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const auto rig = folder_.path() / "glossy" / "rig.toml";
  std::string text = testing::text_of(rig);
  const std::string heading = "[devices.camera]\n";
  text.insert(text.find(heading) + heading.size(), "gloss = 0.9\nshininess = 60\n");
  std::ofstream(rig) << text;
  const auto exposure_ms = [&] { return project().at("capture").at("exposure_ms").get<double>(); };
  command("find-exposure", {{"bracket", true}});
  ASSERT_TRUE(wait([&] { return !project().at("capture").at("exposures_ms").empty(); }));
  const Json exposures = project().at("capture").at("exposures_ms");
  EXPECT_GT(exposures.size(), 1U);
  EXPECT_EQ(exposures[0], exposure_ms());
  EXPECT_NE(error_of([&] { command("set-capture", {{"exposures_ms", {1.0, 0.0}}}); }), "");
  EXPECT_NE(error_of([&] { command("set-capture", {{"exposures_ms", 3.0}}); }), "");
  command("set-capture", {{"exposures_ms", Json::array()}, {"stations", 5}});
  EXPECT_TRUE(project().at("capture").at("exposures_ms").empty());
  EXPECT_EQ(project().at("stations").size(), 5U);
}

TEST_F(LiveServiceTest, FindsAndTakesDevices) {
  command("find-devices");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json search = Json::parse(service_.state()).at("search");
  EXPECT_EQ(search.at("drivers").size(), testing::all_drivers().size());
  EXPECT_EQ(search.at("drivers")[0].at("table"), "camera");

  const Json camera = project().at("devices")[0];
  ASSERT_EQ(camera.at("table"), "camera");
  EXPECT_NE(camera.at("settings").get<std::string>().find("part = \"plate\""), std::string::npos);
  Json devices{{"camera", "driver = \"simulated\"\npart = \"shaft\"\n"},
               {"fringes", "driver = \"simulated-display\"\n"}};
  command("set-devices", {{"devices", devices}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  ASSERT_EQ(project().at("devices").size(), 2U) << service_.state();
  const Json tested = project().at("devices");
  for (const Json& device : tested)
    EXPECT_NE(device.at("answer"), "") << device;
  EXPECT_FALSE(project().at("rig").is_null()) << "its geometry stays";

  devices["camera"] = "driver = \"folder\"\nfolder = \"/\"\n";
  command("set-devices", {{"devices", devices}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_NE(project().at("devices")[0].at("settings").get<std::string>().find("shaft"),
            std::string::npos);
  EXPECT_NE(error_of([&] { command("set-devices", {{"devices", {{"../x", "a = 1"}}}}); }), "");
  EXPECT_NE(error_of([&] { command("set-devices", {{"devices", 3}}); }), "");

  command("create-project", {{"name", "mine"}, {"devices", true}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_FALSE(project().at("can_scan").get<bool>());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "mine" / "rig.toml"));
  EXPECT_NE(error_of([&] { command("start-live"); }).find("step Rig"), std::string::npos);
  EXPECT_NE(
      error_of([&] {
        command("create-project", {{"name", "both"}, {"devices", true}, {"example", "lab-piezo"}});
      }),
      "");
  EXPECT_NE(error_of([&] {
              command("create-project", {{"name", "bad"}, {"rig", "format = \"x\"\n"}});
            }),
            "");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "bad"));
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

  const auto kept = project().at("kept_rigs");
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].at("before"), "geometry");
  command("restore-rig", {{"number", kept[0].at("number")}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_NEAR(project().at("rig").at("turntable").at("distance_mm").get<double>(), distance, 1e-9);
  const Rig simulated = read_rig(folder_.path() / "live" / "true-rig.toml");
  EXPECT_NEAR(simulated.turntable->point_mm.norm(), distance, 1e-9)
      << "the simulated parts as well";
  EXPECT_EQ(project().at("kept_rigs").size(), 2U);
}

TEST_F(LiveServiceTest, MovesNoRigThatIsCalibratedAndKeepsItForOtherProjects) {
  const std::filesystem::path file = folder_.path() / "live" / "rig.toml";
  Rig rig = read_rig(file);
  EXPECT_TRUE(project().at("rig_adjustable").get<bool>());
  rig.calibration = Calibration{.date = "2026-11-26", .poses = 12, .point_sigma_mm = 0.02};
  command("close-project");
  const std::filesystem::path fresh = folder_.path() / "live" / "fresh.toml";
  write_rig(fresh, rig, Durability::Buffered, file);
  std::filesystem::rename(fresh, file);
  command("open-project", {{"name", "live"}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_FALSE(project().at("rig_adjustable").get<bool>());
  EXPECT_NE(error_of([&] { command("set-rig", {{"distance_mm", 300.0}}); }), "");
  EXPECT_FALSE(project().at("rig").at("calibration").is_null()) << "a slider wipes no calibration";

  command("check-scan");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json check = project().at("check");
  ASSERT_FALSE(check.is_null()) << service_.state();
  EXPECT_GT(check.at("points").get<int>(), 1000);
  EXPECT_GT(check.at("contrast").get<double>(), 0.5);
  EXPECT_EQ(check.at("finding"), "");
  command("set-capture", {{"exposure_ms", 3.0}});
  EXPECT_TRUE(project().at("check").is_null()) << "it was of other settings";

  command("keep-rig", {{"name", "Bench"}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  command("create-project", {{"name", "second"}, {"kept_rig", "Bench"}, {"stations", 2}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_EQ(project().at("rig").at("calibration").at("point_sigma_mm"), 0.02);
  EXPECT_TRUE(project().at("can_scan").get<bool>());
}

TEST_F(LiveServiceTest, MeasuresTheDisplayAndKeepsInTheRigWhatItFound) {
  const auto file = folder_.path() / "live" / "rig.toml";
  command("close-project");
  for (const auto& one : {file, folder_.path() / "live" / "true-rig.toml"}) {  // quicker
    Rig coarse = read_rig(one);
    testing::make_coarser(coarse.reference().model, 8);
    write_rig(one, coarse, Durability::Buffered, one);
  }
  std::string rig = testing::text_of(file);
  const std::string table = "[devices.fringes]\n";
  ASSERT_NE(rig.find(table), std::string::npos) << rig;
  rig.replace(rig.find(table), table.size(), table + "latency_ms = 40\n");
  std::ofstream(file) << rig;
  command("open-project", {{"name", "live"}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_TRUE(project().at("display").is_null());
  command("measure-display");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json found = project().at("display");
  ASSERT_FALSE(found.is_null()) << service_.state();
  EXPECT_NEAR(found.at("latency_s").get<double>(), 0.04, 0.001);
  EXPECT_NEAR(found.at("half_light").get<double>(), 0.5, 0.02);
  const std::vector<DeviceSettings> devices = read_device_settings(file);
  const auto fringes = std::find_if(
      devices.begin(), devices.end(), [](const auto& one) { return one.device() == "fringes"; });
  ASSERT_NE(fringes, devices.end());
  EXPECT_EQ(DeviceSettings(*fringes).number("delay_s"), found.at("delay_s").get<double>());
  EXPECT_TRUE(read_rig(file).projector.response);
  EXPECT_EQ(project().at("kept_rigs")[0].at("before"), "display");
  command("restore-rig", {{"number", project().at("kept_rigs")[0].at("number")}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_EQ(testing::text_of(file), rig);
  EXPECT_TRUE(project().at("display").is_null()) << "it was of the other rig";
}

TEST_F(LiveServiceTest, KeepsNoCheckOfOtherSettings) {
  command("close-project");
  std::atomic<bool> changes = false;
  Service* service = nullptr;
  ServiceOptions changing = options();
  changing.capture.hold_devices = [&]() -> std::shared_ptr<void> {
    if (changes.exchange(false))
      static_cast<void>(service->command("set-capture", R"({"exposure_ms": 3.0})"));
    return nullptr;
  };
  Service other(std::move(changing), [] {});
  service = &other;
  const auto of = [&](const char* part) { return Json::parse(other.state()).at(part); };
  const auto finish = [&] {
    ASSERT_TRUE(wait([&] {
      const Json jobs = of("jobs");
      return std::all_of(jobs.begin(), jobs.end(), [](const Json& job) {
        return job.at("state") != "waiting" && job.at("state") != "running";
      });
    }));
  };
  static_cast<void>(other.command("open-project", R"({"name": "live"})"));
  finish();
  changes = true;
  static_cast<void>(other.command("check-scan", "{}"));
  finish();
  EXPECT_EQ(of("jobs").back().at("state"), "done");
  EXPECT_EQ(of("project").at("capture").at("exposure_ms"), 3.0);
  EXPECT_TRUE(of("project").at("check").is_null());
  static_cast<void>(other.command("check-scan", "{}"));
  finish();
  EXPECT_FALSE(of("project").at("check").is_null());
}

}  // namespace
}  // namespace frangia
