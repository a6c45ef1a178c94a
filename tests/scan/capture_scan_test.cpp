#include "frangia/scan/capture_scan.h"

#include <fstream>
#include <iterator>
#include <map>
#include <stop_token>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/devices/device_error.h"
#include "frangia/devices/folder_camera.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/simulated_drivers.h"

#include "scan/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using Values = std::map<std::string, SettingValue>;
using Texts = std::vector<std::string>;

/// A rig of 128 pixels whose devices are simulated, and a plan of three views.
class CaptureScan : public ::testing::Test {
 protected:
  CaptureScan() {
    roles_["camera"]["part"] = std::string("ball-bar");
    for (const char* role : {"camera", "phase_shifter", "line_source", "laser", "turntable"})
      roles_[role]["driver"] = std::string("simulated");
    plan_.folder = folder_.path() / "scan";
    plan_.name = "scan";
    plan_.rig = testing::small_rig("angular");
    plan_.rig.camera.lens.width_px /= 2;
    plan_.rig.camera.lens.height_px /= 2;
    plan_.rig.camera.lens.focal_px *= 0.5;
    plan_.rig.camera.lens.principal_point_px *= 0.5;
    plan_.rig.camera.noise = NoiseModel::from_camera(78.4, 8.0);
    plan_.patterns = default_patterns(plan_.rig);
    for (int i = 0; i < 3; ++i)
      plan_.views.push_back({kTurn * i / 3, "views/00" + std::to_string(i)});
  }

  CaptureReport capture(const CaptureOptions& options = {}) {
    DriverRegistry registry;
    add_simulated_drivers(registry);
    add_folder_camera(registry);
    std::vector<DeviceSettings> settings;
    for (const auto& [role, values] : roles_)
      settings.emplace_back("rig.toml", role, values);
    const Devices devices = open_devices(settings, registry, plan_.rig);
    frangia::Run run;
    run.stop = stop_.get_token();
    run.on_warning = [this](const std::string& sentence) { warnings_.push_back(sentence); };
    run.on_note = [this](const std::string& sentence) { notes_.push_back(sentence); };
    run.progress = [this](double done) {
      if (done > stop_at_) stop_.request_stop();
    };
    return capture_scan(plan_, devices, options, run);
  }

  /// The bytes of all files of the scan, by name.
  [[nodiscard]] std::map<std::string, std::string> bytes() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(plan_.folder)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      all[std::filesystem::relative(entry.path(), plan_.folder).string()] = {
          std::istreambuf_iterator<char>(in), {}};
    }
    return all;
  }

  testing::TemporaryFolder folder_;
  std::map<std::string, Values> roles_;
  Scan plan_;
  std::vector<std::string> warnings_;
  std::vector<std::string> notes_;
  std::stop_source stop_;
  double stop_at_ = 2.0;
};

TEST_F(CaptureScan, WritesAScanThatReadsBackWithAVerdictOfEachView) {
  const CaptureReport report = capture();
  EXPECT_EQ(report.taken, 15U);
  EXPECT_TRUE(report.skipped.empty());
  EXPECT_EQ(notes_.size(), 3U);
  EXPECT_NE(notes_.front().find("contrast"), std::string::npos);
  const Scan scan = read_scan(plan_.folder);
  EXPECT_EQ(scan.views.size(), 3U);
  EXPECT_EQ(read_frames(scan, 2).size(), 2U);
}

TEST_F(CaptureScan, InterruptedGoesOnToTheSameBytes) {
  roles_["phase_shifter"]["gain_error"] = 0.05;
  roles_["phase_shifter"]["hysteresis_v"] = 1.0;
  roles_["phase_shifter"]["jitter_deg"] = 0.2;
  static_cast<void>(capture());
  const auto whole = bytes();
  for (const double stop_at : {0.1, 0.3, 0.4, 0.65, 0.9}) {
    std::filesystem::remove_all(plan_.folder);
    stop_ = std::stop_source();
    stop_at_ = stop_at;
    EXPECT_THROW(static_cast<void>(capture()), Error);
    EXPECT_FALSE(std::filesystem::exists(plan_.folder / "scan.toml"));
    stop_ = std::stop_source();
    stop_at_ = 2.0;
    EXPECT_GT(capture().resumed + 15U, 15U) << stop_at;
    EXPECT_EQ(bytes(), whole) << stop_at;
  }
}

TEST_F(CaptureScan, DamagedFrameIsTakenAgain) {
  static_cast<void>(capture());
  const auto whole = bytes();
  std::filesystem::resize_file(plan_.folder / "views/001/fringe-2.png", 100);
  EXPECT_EQ(capture().taken, 1U);
  const auto again = bytes();
  EXPECT_EQ(again.at("views/001/fringe-2.png"), whole.at("views/001/fringe-2.png"));
}

TEST_F(CaptureScan, LostAndIncompleteFramesAreTakenAgain) {
  roles_["camera"]["faults"] = Texts{"lost 0 fringe 1", "incomplete 1 fringe 2"};
  const CaptureReport report = capture();
  EXPECT_EQ(report.frame_retries, 2U);
  EXPECT_TRUE(report.skipped.empty());
}

TEST_F(CaptureScan, TableThatIsStuckOrInAlarmIsTriedAgainThenTheViewIsSkippedAndNamed) {
  roles_["turntable"]["faults"] = Texts{"alarm 120", "stuck 240 always"};
  const CaptureReport report = capture();
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(report.skipped.front().find("view 2: turntable (simulated)"), std::string::npos);
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 2U);
  roles_["turntable"].erase("faults");  // freed: the same command takes what is missing
  EXPECT_EQ(capture().taken, 5U);
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 3U);
}

TEST_F(CaptureScan, UnpluggedCameraEndsTheScanWhichGoesOnLater) {
  roles_["camera"]["faults"] = Texts{"unplugged 1 fringe 2"};
  EXPECT_THROW(static_cast<void>(capture()), DeviceError);
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/fringe-1.png"));
  roles_["camera"].erase("faults");
  EXPECT_EQ(capture().taken, 8U);
}

TEST_F(CaptureScan, SetThatShowsMotionIsTakenAgainAndTheOldFramesKept) {
  roles_["camera"]["faults"] = Texts{"motion 1 fringe"};
  const CaptureReport report = capture();
  EXPECT_EQ(report.set_retakes, 1U);
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/rejected/0-fringe-3.png"));
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/fringe-3.png"));
}

TEST_F(CaptureScan, AutomaticExposureLiftsADarkScene) {
  CaptureOptions options;
  options.camera.exposure_ms = 0.5;
  options.auto_exposure = true;
  static_cast<void>(capture(options));
  int brightest = 0;
  for (const Frame& frame : read_frames(read_scan(plan_.folder), 0)[0].frames) {
    for (int y = 0; y < height_of(frame); ++y) {
      for (int x = 0; x < width_of(frame); ++x)
        brightest = std::max(brightest, counts_at(frame, x, y));
    }
  }
  EXPECT_GT(brightest, 200);
}

TEST_F(CaptureScan, FolderOfFramesIsReplayed) {
  static_cast<void>(capture());
  const auto first = bytes();
  roles_["camera"] = {{"driver", std::string("folder")}, {"folder", plan_.folder.string()}};
  plan_.folder = folder_.path() / "again";
  static_cast<void>(capture());
  EXPECT_EQ(bytes().at("views/002/fringe-0.png"), first.at("views/002/fringe-0.png"));
}

TEST_F(CaptureScan, BadInputIsOneSentenceAndWhatWasCapturedIsKept) {
  const auto complaint = [this] {
    try {
      static_cast<void>(capture());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  roles_["turntable"]["limits_deg"] = std::vector<double>{0.0, 200.0};
  EXPECT_NE(complaint().find("240 degrees is out of its limits"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/line-0.png"));
  plan_.patterns.front().shifts_rad.pop_back();
  EXPECT_NE(complaint().find("holds another scan"), std::string::npos);
  roles_["camera"] = {{"driver", std::string("folder")}, {"folder", plan_.folder.string()}};
  plan_.folder = folder_.path() / "other";
  plan_.rig.camera.lens.width_px += 2;
  EXPECT_NE(complaint().find("camera.size_px"), std::string::npos);
  roles_.erase("laser");
  roles_.erase("phase_shifter");
  EXPECT_NE(complaint().find("[devices.phase_shifter]"), std::string::npos);
}

}  // namespace
}  // namespace frangia
