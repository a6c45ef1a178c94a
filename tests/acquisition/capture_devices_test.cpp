#include "frangia/acquisition/internal/capture_devices.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

using testing::error_of;

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

TEST_F(CaptureWithTable, MovesHaveTheTimeLimitPlusOneAndAHalfTimesTheirDuration) {
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

}  // namespace
}  // namespace frangia
