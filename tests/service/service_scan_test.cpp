#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/read_file.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/files/write_mesh.h"
#include "frangia/files/zip_folder.h"
#include "frangia/reconstruct/reconstruct.h"

#include "service/service_fixture.h"
#include "support/small_scan.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using Json = nlohmann::json;

TEST_F(ServiceTest, ScansTheTurnedPartAsASecondSetupOnceTheFirstIsComplete) {
  static_cast<void>(
      command("create-project", {{"name", "try"}, {"part", "plate"}, {"stations", 2}}));
  static_cast<void>(finish());
  EXPECT_NE(refusal("start-scan", R"({"setup": 1})").find("not complete"), std::string::npos);
  static_cast<void>(command("start-scan"));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_NE(refusal("start-scan", R"({"setup": 2})"), "");
  static_cast<void>(command("start-scan", {{"setup", 1}, {"stations", 1}}));
  ASSERT_EQ(finish().at("state"), "done");
  const Json stations = state().at("project").at("stations");
  ASSERT_EQ(stations.size(), 3U);
  EXPECT_EQ(stations[1].at("setup"), 0);
  EXPECT_EQ(stations[2].at("setup"), 1);
  EXPECT_EQ(stations[2].at("angle_deg"), 0.0);
  EXPECT_EQ(stations[2].at("state"), "done");
  EXPECT_NE(refusal("rescan-station", R"({"station": 1})").find("turned over"), std::string::npos);
  // The stations of both setups are found again, and the frames of neither are captured again.
  restart();
  static_cast<void>(command("open-project", {{"name", "try"}}));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("stations"), stations);
  static_cast<void>(command("rescan-station", {{"station", 2}}));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("project").at("stations"), stations);
}

TEST_F(ServiceTest, StopsAndContinuesTheSimulatedScan) {
  std::atomic<bool> stops = false;
  at_changes([&] {  // on the thread of the scan, so that it cannot end before
    if (!stops) return;
    const Json jobs = state().at("jobs");
    for (const Json& job : jobs) {
      if (job.at("state") == "running" && job.at("stage") == "scan" && job.at("progress") >= 0.3)
        static_cast<void>(command("stop-job", {{"job", job.at("number")}}));
    }
  });
  static_cast<void>(
      command("create-project", {{"name", "try"}, {"part", "plate"}, {"stations", 2}}));
  static_cast<void>(finish());
  stops = true;
  static_cast<void>(command("start-scan"));
  EXPECT_EQ(finish().at("state"), "stopped");
  stops = false;
  EXPECT_FALSE(state().at("project").at("scan_complete").get<bool>());
  EXPECT_NE(refusal("start-scan", R"({"stations": 3})"), "");

  at_changes({});
  restart();
  static_cast<void>(command("open-project", {{"name", "try"}}));
  static_cast<void>(finish());
  static_cast<void>(command("start-scan"));
  const Json job = finish();
  ASSERT_EQ(job.at("state"), "done") << job.at("error");
  const Json project = state().at("project");
  EXPECT_TRUE(project.at("scan_complete").get<bool>());
  for (const Json& station : project.at("stations"))
    EXPECT_EQ(station.at("state"), "done");
  EXPECT_TRUE(project.at("stations")[1].at("good").get<bool>());
  EXPECT_GT(project.at("stations")[1].at("points").get<int>(), 5000);
  EXPECT_NE(refusal("rescan-station", R"({"station": 2})"), "");
  static_cast<void>(command("rescan-station", {{"station", 1}}));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("project").at("stations")[1], project.at("stations")[1])
      << "the simulated rig captures the same frames again";
  static_cast<void>(command("export", {{"format", "zip"}}));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_GT(std::filesystem::file_size(service_->exported("try scan.zip").path), 50'000U);
  EXPECT_FALSE(service_->cloud(1).empty());
  EXPECT_TRUE(service_->cloud(9).empty());
  EXPECT_GT(changes_, 10);
}

TEST_F(ServiceTest, OpensAScanFromAFileAndCapturesNothingOverIt) {
  const auto scan = folder_.path() / "scan";
  static_cast<void>(testing::small_scan(scan, "plate", "angular", 1, {.samples_per_px = 1}));
  ASSERT_FALSE(std::filesystem::exists(scan / "capture"));
  const auto archive = folder_.path() / "scan.zip";
  zip_folder(scan, "plate", archive);
  const std::string bytes = read_text_file(archive);
  static_cast<void>(
      command("create-project", {{"name", "mine"}, {"part", "plate"}, {"stations", 8}}));
  static_cast<void>(finish());
  service_->add_to_reference(0, bytes);
  static_cast<void>(command("open-file", {{"format", "zip"}, {"bytes", bytes.size()}}));
  service_->add_to_reference(0, "the next file");
  const Json job = finish();
  ASSERT_EQ(job.at("state"), "done") << job.at("error");
  const auto is_kept = [&] {
    const Json project = state().at("project");
    EXPECT_TRUE(project.at("scan_complete").get<bool>());
    EXPECT_TRUE(project.at("scan_begun").get<bool>());
    EXPECT_EQ(project.at("stations").size(), 1U);
    for (const auto& [name, arguments] : std::vector<std::pair<std::string, std::string>>{
             {"set-capture", R"({"exposure_ms": 3})"},
             {"set-capture", R"({"stations": 3})"},
             {"find-exposure", "{}"},
             {"set-devices", R"({"devices": {"camera": "driver = \"simulated\"\n"}})"},
             {"start-calibration", R"({"square_mm": 10})"},
             {"start-scan", "{}"},
             {"start-scan", R"({"setup": 1})"},
             {"rescan-station", R"({"station": 0})"}})
      EXPECT_NE(refusal(name, arguments), "") << name;
    const auto project_scan = folder_.path() / "projects" / "mine" / "scan";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scan))
      EXPECT_TRUE(std::filesystem::exists(project_scan / entry.path().lexically_relative(scan)))
          << entry;
  };
  is_kept();
  restart();
  static_cast<void>(command("open-project", {{"name", "mine"}}));
  static_cast<void>(finish());
  is_kept();
}

/// The surface that the library makes of a scan folder, as bytes of a PLY file.
std::string surface_of(const std::filesystem::path& scan,
                       const std::filesystem::path& file,
                       const ReconstructOptions& options = {}) {
  write_mesh(file, reconstruct(read_scan(scan), options).mesh);
  return testing::text_of(file);
}

TEST_F(ServiceTest, BuildsAsFewTrianglesAsAreAskedFor) {
  static_cast<void>(
      command("create-project", {{"name", "few"}, {"part", "plate"}, {"stations", 2}}));
  static_cast<void>(finish());
  static_cast<void>(command("start-scan"));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_EQ(refusal("reconstruct", R"({"max_triangles": 3})"),
            "max_triangles: a whole number from 4 to 1000000000 is missing here");
  EXPECT_NE(refusal("reconstruct", R"({"max_triangles": 1000.5})"), "");
  const auto project = folder_.path() / "projects" / "few";
  ReconstructOptions options;
  options.fusion.voxel_mm = 1.5;
  options.finish.watertight = true;
  options.finish.max_triangles = 1000;
  const std::string wanted = surface_of(project / "scan", folder_.path() / "wanted.ply", options);
  static_cast<void>(
      command("reconstruct", {{"voxel_mm", 1.5}, {"watertight", true}, {"max_triangles", 1000}}));
  ASSERT_EQ(finish().at("state"), "done");
  EXPECT_TRUE(testing::text_of(project / "versions" / "001" / "surface.ply") == wanted);
  EXPECT_LE(state().at("project").at("surface").at("triangles").get<int>(), 1000);
}

TEST_F(ServiceTest, BuildsTheSameBytesFromTheViewsThatItDecodedDuringTheScan) {
  static_cast<void>(
      command("create-project", {{"name", "try"}, {"part", "plate"}, {"stations", 2}}));
  static_cast<void>(finish());
  static_cast<void>(command("start-scan"));
  ASSERT_EQ(finish().at("state"), "done");
  const auto project = folder_.path() / "projects" / "try";
  const std::string wanted = surface_of(project / "scan", folder_.path() / "wanted.ply");
  const auto build = [&](int version) {
    static_cast<void>(command("reconstruct"));
    EXPECT_EQ(finish().at("state"), "done");
    return testing::text_of(project / "versions" / fmt::format("{:03}", version) / "surface.ply");
  };
  EXPECT_TRUE(build(1) == wanted);
  // Frames that seem to be the same are not read again; those that changed are.
  const auto views = project / "scan" / "views";
  std::filesystem::path frame;
  for (const auto& entry : std::filesystem::directory_iterator(views / "001"))
    if (frame.empty() || entry.path() < frame) frame = entry.path();
  const auto time = std::filesystem::last_write_time(frame);
  const std::string bytes = testing::text_of(frame);
  std::ofstream(frame, std::ios::binary) << std::string(bytes.size(), 'x');
  std::filesystem::last_write_time(frame, time);
  EXPECT_TRUE(build(2) == wanted);
  std::filesystem::last_write_time(frame, time + std::chrono::seconds(1));
  static_cast<void>(command("reconstruct"));
  EXPECT_EQ(finish().at("state"), "failed") << "a damaged frame was not read";
}

}  // namespace
}  // namespace frangia
