#include "frangia/acquisition/internal/capture_devices.h"

#include <algorithm>

#include "frangia/acquisition/internal/check_devices.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

using testing::error_of;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A turntable that records the laser sheet and the deadline of each move. Its angle is where it is
/// enabled, and a fault loses it.
class WatchedTable final : public TurntableDevice {
 public:
  explicit WatchedTable(const SwitchDevice& laser) : laser_(laser) {}

  [[nodiscard]] std::string name() const override { return "table"; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override { return "works"; }
  void make_safe() noexcept override { angle_rad_.reset(); }
  [[nodiscard]] const TurntableInfo& info() const override { return info_; }
  void enable(bool /*on*/, const Deadline& /*deadline*/) override {}
  void home(const Deadline& /*deadline*/) override { angle_rad_ = 0.0; }
  [[nodiscard]] std::optional<double> angle_rad() const override { return angle_rad_; }
  void move_to(double angle_rad, const Deadline& deadline) override {
    laser_was_on = laser_was_on || laser_.is_on();
    timeout_s = deadline.timeout_s;
    if (angle_rad > fault_at_rad) {
      angle_rad_.reset();
      fail_device(*this, "ALARM:1, a limit switch was hit");
    }
    angle_rad_ = angle_rad;
  }
  [[nodiscard]] double move_time_s(double /*angle_rad*/) const override { return 4.0; }

  bool laser_was_on = false;
  double timeout_s = 0.0;
  double fault_at_rad = 100.0;

 private:
  const SwitchDevice& laser_;
  TurntableInfo info_;
  std::optional<double> angle_rad_;
};

class CaptureWithTable : public testing::SimulatedCapture {
 protected:
  /// The devices with a watched table.
  [[nodiscard]] RigDevices open_watched(WatchedTable*& table) const {
    RigDevices devices = open();
    auto watched = std::make_unique<WatchedTable>(*devices.laser_sheet);
    table = watched.get();
    devices.turntable = std::move(watched);
    return devices;
  }
};

TEST_F(CaptureWithTable, LaserSheetIsOffInEveryMove) {
  WatchedTable* table = nullptr;
  RigDevices devices = open_watched(table);
  static_cast<void>(capture_scan(plan_, devices));
  EXPECT_FALSE(table->laser_was_on);
}

TEST_F(CaptureWithTable, MovesHaveThePatienceAndHalfMoreThanTheirDuration) {
  WatchedTable* table = nullptr;
  RigDevices devices = open_watched(table);
  CaptureOptions options;
  options.timeout_s = 2.5;
  static_cast<void>(capture_scan(plan_, devices, options));
  EXPECT_DOUBLE_EQ(table->timeout_s, 2.5 + 1.5 * 4.0);
}

TEST_F(CaptureWithTable, TheFirstCauseOfALostAngleIsReported) {
  WatchedTable* table = nullptr;
  RigDevices devices = open_watched(table);
  table->fault_at_rad = 1.0;
  const std::string sentence = error_of([&] { static_cast<void>(capture_scan(plan_, devices)); });
  EXPECT_EQ(sentence.find("table: ALARM:1, a limit switch was hit; consequence: table: its angle"),
            0U)
      << sentence;
}

TEST_F(CaptureWithTable, AFaultAtAKnownAngleIsRetriedWithoutAHomeSwitch) {
  devices_["camera"] += "faults = [\"lost 1 fringe 2\"]\n";
  WatchedTable* table = nullptr;
  RigDevices devices = open_watched(table);
  EXPECT_TRUE(capture_scan(plan_, devices).skipped.empty());
}

/// A pattern of each kind with `frames` frames.
std::vector<Pattern> patterns_of_each_kind(const Rig& rig) {
  Pattern fringe{.name = "fringe", .shifts_rad = {0.0, 1.0, 2.0}};
  (rig.projector.is_angular() ? fringe.fringes_per_degree : fringe.period_px) = 10.0;
  return {fringe,
          {.name = "line", .kind = PatternKind::Line},
          {.name = "gray", .kind = PatternKind::Gray, .bits = 3},
          {.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 0.5, 1.0}}};
}

class CheckDevices : public testing::SimulatedCapture {
 protected:
  /// The kinds of patterns that the devices can show.
  [[nodiscard]] std::string shown() {
    const RigDevices devices = open();
    std::string kinds;
    for (const Pattern& pattern : patterns_of_each_kind(plan_.rig)) {
      plan_.patterns = {pattern};
      if (complaint(devices).empty()) kinds += pattern.name + " ";
    }
    return kinds;
  }
  [[nodiscard]] std::string complaint(const RigDevices& devices) const {
    try {
      check_devices(devices, plan_, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Input) << error.what();
      return error.what();
    }
    return {};
  }
};

TEST_F(CheckDevices, RefusesEachKindOfPatternThatTheDevicesCannotShow) {
  EXPECT_EQ(shown(), "fringe line ");
  devices_.erase("line");
  EXPECT_EQ(shown(), "fringe ");
  devices_.erase("fringes");
  EXPECT_EQ(shown(), "");
  use("digital", 4);
  devices_.erase("line");
  EXPECT_EQ(shown(), "fringe gray ramp ");
  devices_.erase("fringes");
  EXPECT_EQ(shown(), "");
}

TEST_F(CheckDevices, RefusesARampOfAnInterferometerBeforeAnyLightIsOn) {
  Pattern ramp{.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 0.5, 1.0}};
  plan_.patterns.insert(plan_.patterns.begin(), ramp);
  RigDevices devices = open();
  const std::string sentence = error_of([&] { static_cast<void>(capture_scan(plan_, devices)); });
  EXPECT_TRUE(contains(sentence, "the pattern \"ramp\" is a grey ramp, which simulated piezo"))
      << sentence;
  EXPECT_FALSE(devices.light->is_on());
  EXPECT_FALSE(std::filesystem::exists(plan_.folder));
}

TEST_F(CheckDevices, RefusesValuesThatTheDevicesCannotShow) {
  const Pattern fringe = plan_.patterns.front();
  const auto expect = [&](const std::string& part, const auto& change) {
    plan_.patterns = {fringe};
    change(plan_.patterns.front());
    const std::string sentence = complaint(open());
    EXPECT_TRUE(contains(sentence, part)) << part << ": " << sentence;
  };
  expect("has no frames", [](Pattern& pattern) { pattern.shifts_rad.clear(); });
  expect("not a finite number", [](Pattern& pattern) { pattern.shifts_rad[1] = std::nan(""); });
  expect("has no fringes_per_degree", [](Pattern& pattern) { pattern.fringes_per_degree = 0.0; });
  expect("the exposure 1e+06 ms is outside the range",
         [](Pattern& pattern) { pattern.exposures_ms = {1e6}; });
  devices_["fringes"] = "driver = \"simulated-piezo\"\nmax_command = 5\ncommand_per_turn = 10\n";
  expect("which simulated piezo cannot show: the phase curve spans", [](Pattern& pattern) {
    pattern.shifts_rad = {0.0, 1.5 * kPi};
  });
  devices_["fringes"] =
      "driver = \"simulated-piezo\"\nmax_command = 12\ncommand_per_turn = 10\n"
      "fringes_per_degree = 3.5\n";
  expect("but simulated piezo shows 3.5",
         [](Pattern& pattern) { pattern.fringes_per_degree = 7.0; });
  use("digital", 4);
  plan_.patterns.front().period_px = 0.0;
  EXPECT_TRUE(contains(complaint(open()), "has no period_px above 0"));
  plan_.patterns = {{.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 2.0}}};
  EXPECT_TRUE(contains(complaint(open()), "has the level 2; levels are from 0 to 1"));
}

}  // namespace
}  // namespace frangia
