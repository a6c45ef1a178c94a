// Devices that vanish and folders that are deleted while the app uses them.
#include <fstream>

#include <gtest/gtest.h>

#include "service/live_service.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::Json;
using testing::LiveServiceTest;

class LostDevicesTest : public LiveServiceTest {
 protected:
  [[nodiscard]] std::filesystem::path rig() const { return folder_.path() / "live" / "rig.toml"; }
  [[nodiscard]] std::string rig_toml() const { return testing::text_of(rig()); }
  /// Adds lines to a table of the rig.
  void add_to(const std::string& table, const std::string& lines) const {
    std::string text = rig_toml();
    const std::string heading = "[devices." + table + "]\n";
    text.insert(text.find(heading) + heading.size(), lines);
    std::ofstream(rig()) << text;
  }
  [[nodiscard]] Json last_job(const std::string& kind) const {
    const Json state = Json::parse(service_.state());
    Json found;
    for (const Json& job : state.at("jobs"))
      if (job.at("kind") == kind) found = job;
    return found;
  }
};

TEST_F(LostDevicesTest, ACameraThatVanishesEndsThePreviewInWords) {
  const std::string before = rig_toml();
  add_to("camera", "faults = [\"unplugged 0 always\"]\n");
  command("start-live");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json job = last_job("live");
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_EQ(job.at("error").get<std::string>().find("simulated camera"), 0U) << job.at("error");
  EXPECT_TRUE(project().at("live").is_null());
  std::ofstream(rig()) << before;  // plugged in again
  command("start-live");
  static_cast<void>(header(LiveLayer::Camera, [](const Json&) { return true; }));
}

TEST_F(LostDevicesTest, ACameraThatVanishesInAScanLosesItsViewOnly) {
  const std::string before = rig_toml();
  add_to("camera", "faults = [\"unplugged 1 always\"]\n");
  command("start-scan");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_EQ(last_job("scan").at("state"), "failed");
  EXPECT_EQ(last_job("scan").at("error").get<std::string>().find("simulated camera"), 0U)
      << last_job("scan");
  Json stations = project().at("stations");
  EXPECT_EQ(stations[0].at("state"), "done");
  EXPECT_TRUE(stations[0].at("has_cloud").get<bool>());
  EXPECT_EQ(stations[1].at("state"), "waiting");
  std::ofstream(rig()) << before;  // plugged in again
  command("start-scan");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  ASSERT_EQ(last_job("scan").at("state"), "done") << last_job("scan");
  stations = project().at("stations");
  EXPECT_EQ(stations[1].at("state"), "done");
  EXPECT_TRUE(project().at("scan_complete").get<bool>());
  const auto notes = last_job("scan").at("log");
  EXPECT_NE(notes.back().at("sentence").get<std::string>().find("already there"),
            std::string::npos);
  EXPECT_EQ(notes.back().at("sentence").get<std::string>().find(" 0 already"), std::string::npos)
      << "the frames of the first view are kept";
}

TEST_F(LostDevicesTest, ADeletedProjectFolderIsNamedAndOthersStayUsable) {
  const auto folder = folder_.path() / "live";
  std::filesystem::remove_all(folder);
  for (const char* name : {"start-live", "start-scan", "test-devices", "reconstruct"}) {
    const std::string refusal = error_of([&] { command(name); });
    EXPECT_NE(refusal.find(folder.string()), std::string::npos) << name << ": " << refusal;
    EXPECT_NE(refusal.find("is gone"), std::string::npos) << refusal;
  }
  EXPECT_NE(error_of([&] { command("set-capture", {{"exposure_ms", 20.0}}); }), "");
  EXPECT_FALSE(std::filesystem::exists(folder)) << "no command creates it again";
  static_cast<void>(service_.state());
  command("close-project");
  EXPECT_TRUE(Json::parse(service_.state()).at("projects").empty());
  command("create-project", {{"name", "next"}, {"part", "plate"}, {"stations", 2}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_EQ(project().at("name"), "next");
}

TEST_F(LostDevicesTest, AFolderThatIsDeletedInAScanEndsItInWords) {
  add_to("camera", "real_time = true\nreference_exposure_ms = 200\n");
  command("set-capture", {{"exposure_ms", 200.0}});
  command("start-scan");
  const auto views = folder_.path() / "live" / "scan" / "views";
  ASSERT_TRUE(wait([&] { return std::filesystem::exists(views) || !busy(); }));
  std::filesystem::remove_all(folder_.path() / "live");
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json job = last_job("scan");
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_NE(job.at("error").get<std::string>().find((folder_.path() / "live").string()),
            std::string::npos)
      << job.at("error");
}

}  // namespace
}  // namespace frangia
