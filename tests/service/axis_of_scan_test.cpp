// The axis of the turntable from the scan of a project that lacks it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/read_file.h"
#include "frangia/service/turntable_axis.h"

#include "service/live_service.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::Json;
using testing::remove_turntable;

/// Makes frames unreadable whose names, sizes and times stay, as long as it lives.
class UnreadableFrames {
 public:
  explicit UnreadableFrames(const std::filesystem::path& views) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(views))
      if (entry.path().extension() == ".png")
        contents_[entry.path()] = read_text_file(entry, kMost);
    EXPECT_FALSE(contents_.empty());
    for (const auto& [file, content] : contents_)
      put(file, std::string(content.size(), 'x'));
  }
  UnreadableFrames(const UnreadableFrames&) = delete;
  UnreadableFrames& operator=(const UnreadableFrames&) = delete;
  UnreadableFrames(UnreadableFrames&&) = delete;
  UnreadableFrames& operator=(UnreadableFrames&&) = delete;
  ~UnreadableFrames() {
    for (const auto& [file, content] : contents_)
      put(file, content);
  }

 private:
  static constexpr std::uint64_t kMost = 64'000'000;
  static void put(const std::filesystem::path& file, const std::string& content) {
    const auto time = std::filesystem::last_write_time(file);
    std::ofstream(file, std::ios::binary) << content;
    std::filesystem::last_write_time(file, time);
  }
  std::map<std::filesystem::path, std::string> contents_;
};

class AxisOfScan : public testing::LiveServiceTest {
 protected:
  /// A project whose rig says nothing of its turntable. Returns the axis that the simulated one
  /// has.
  Turntable make(const std::string& part, int stations) {
    command("create-project", {{"name", "part"}, {"part", part}, {"stations", stations}});
    EXPECT_TRUE(wait([&] { return !busy(); }));
    const Turntable truth = read_rig(folder() / "rig.toml").turntable.value();
    command("close-project");
    remove_turntable(folder() / "rig.toml");
    open();
    return truth;
  }
  void open() {
    command("open-project", {{"name", "part"}});
    EXPECT_TRUE(wait([&] { return !busy(); }));
  }
  void done(const std::string& name, const Json& arguments = Json::object()) {
    command(name, arguments);
    ASSERT_TRUE(wait([&] { return !busy(); }));
    EXPECT_EQ(Json::parse(service_.state()).at("jobs").back().at("state"), "done")
        << service_.state();
  }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path() / "part"; }
};

TEST_F(AxisOfScan, IsFoundWithItsUncertaintyAndTheSurfaceIsBuilt) {
  const Turntable truth = make("bust", 6);
  EXPECT_NE(error_of([&] { command("start-scan"); }).find("axis of the turntable is unknown"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              command("start-scan", {{"find_axis", true}, {"stations", 2}});
            }).find("three stations"),
            std::string::npos);
  done("start-scan", {{"find_axis", true}});
  const Json axis = project().at("axis");
  ASSERT_FALSE(axis.is_null()) << service_.state();
  EXPECT_TRUE(axis.at("of_scan").get<bool>());
  EXPECT_EQ(axis.at("views").get<int>(), 6);
  EXPECT_EQ(project().at("axis_fault"), "");
  EXPECT_EQ(project().at("kept_rigs")[0].at("before"), "axis");
  const Turntable found = read_rig(folder() / "rig.toml").turntable.value();
  const double turned_rad = std::acos(std::min(1.0, found.axis.dot(truth.axis)));
  EXPECT_LT(turned_rad, 0.002);
  EXPECT_LT(turned_rad, 4.0 * found.axis_sigma_rad);
  const Eigen::Vector3d between = found.point_mm - truth.point_mm;
  EXPECT_LT((between - between.dot(truth.axis) * truth.axis).norm(), 0.2);
  EXPECT_EQ(read_rig(folder() / "scan" / "rig.toml").turntable.value().axis, found.axis);
  const Json scanned = project();  // a loop over a part of what a call returns does not keep it
  for (const Json& station : scanned.at("stations"))
    EXPECT_TRUE(station.at("has_cloud").get<bool>());
  // The views are those that were decoded during the scan: the surface needs no frame again.
  {
    const UnreadableFrames frames(folder() / "scan" / "views");
    done("reconstruct", {{"voxel_mm", 2.0}});
    EXPECT_EQ(project().at("surface").at("summary").at("views"), 6);
  }
  // The frames are those of the same scan: a station can be captured again, and only its views are
  // decoded.
  done("rescan-station", {{"station", 2}});
  EXPECT_TRUE(project().at("scan_complete").get<bool>());
  const UnreadableFrames frames(folder() / "scan" / "views");
  done("reconstruct", {{"voxel_mm", 2.0}});
  EXPECT_EQ(project().at("surface").at("summary").at("views"), 6);
}

TEST_F(AxisOfScan, IsNotThatOfARoundPartWhoseFramesAreKept) {
  static_cast<void>(make("shaft", 3));
  done("start-scan", {{"find_axis", true}});
  EXPECT_TRUE(project().at("axis").is_null());
  const std::string fault = project().at("axis_fault");
  EXPECT_TRUE(fault.starts_with("the part does not show the axis of the turntable")) << fault;
  EXPECT_TRUE(project().at("scan_complete").get<bool>());
  EXPECT_TRUE(project().at("rig").at("turntable").is_null());
  const auto frame = folder() / "scan" / "views" / "000";
  EXPECT_FALSE(std::filesystem::is_empty(frame));
  EXPECT_NE(error_of([&] { command("find-axis"); }).find("the board is not known"),
            std::string::npos);
  // The wizard may look for it although the scan has begun.
  command("find-axis", {{"square_mm", 14.0}, {"columns", 10}, {"rows", 7}});
}

}  // namespace
}  // namespace frangia
