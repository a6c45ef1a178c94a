#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/simulate/internal/fault_script.h"
#include "frangia/simulate/internal/simulated_devices.h"

namespace frangia {
namespace {

/// An angle in degrees for messages, without the rounding errors of radians.
std::string degrees(double angle_rad) {
  return fmt::format("{:.6g}", deg_from_rad(angle_rad));
}

class SimulatedTable final : public TurntableDevice {
 public:
  SimulatedTable(DeviceSettings& settings, BenchPtr bench)
      : bench_(std::move(bench)),
        faults_(read_faults(settings, {"stuck", "alarm", "unplugged"})),
        backlash_rad_(rad_from_deg(settings.number_or("backlash_deg", 0.0, 0.0, 30.0))),
        approach_rad_(rad_from_deg(settings.number_or("approach_deg", 2.0, 0.0, 90.0))),
        error_rad_(rad_from_deg(settings.number_or("angle_error_deg", 0.0, 0.0, 10.0))),
        deg_per_s_(settings.number_or("speed_deg_per_s", 0.0, 0.0, 1e6)) {
    info_.can_home = settings.choice("home", {"switch", "here"}) == "switch";
    table_rad_ = offset_rad_ = rad_from_deg(settings.number_or("start_deg", 0.0, -1e6, 1e6));
    bench_->table_rad = table_rad_;
    constexpr double kMany_deg = 1e6;
    info_.min_rad = rad_from_deg(settings.number_or("min_deg", -kMany_deg));
    info_.max_rad = rad_from_deg(settings.number_or("max_deg", kMany_deg));
    if (!(info_.min_rad < info_.max_rad)) settings.fail("min_deg", "must be below max_deg");
  }

  [[nodiscard]] std::string name() const override { return "simulated turntable"; }
  [[nodiscard]] const TurntableInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    if (unplugged_) fail_device(*this, "does not answer; is its cable plugged in?");
    return homed_ ? "at " + degrees(motor_rad_) + " degrees" : "not homed";
  }
  void make_safe() noexcept override {
    enabled_ = false;
    homed_ = false;
  }
  void enable(bool on, const Deadline& /*deadline*/) override { enabled_ = on; }
  void home(const Deadline& deadline) override {
    if (!info_.can_home) return set_angle(0.0, deadline);
    check_enabled();
    homed_ = true;
    offset_rad_ = 0.0;
    turn_to(-approach_rad_);
    turn_to(0.0);
  }
  void set_angle(double angle_rad, const Deadline& /*deadline*/) override {
    check_enabled();
    homed_ = true;
    offset_rad_ += motor_rad_ - angle_rad;
    motor_rad_ = angle_rad;
  }
  [[nodiscard]] std::optional<double> angle_rad() const override {
    return homed_ ? std::optional(motor_rad_) : std::nullopt;
  }

  void move_to(double angle_rad, const Deadline& deadline) override {
    constexpr double kRounding = 1e-9;
    if (angle_rad < info_.min_rad - kRounding || angle_rad > info_.max_rad + kRounding) {
      fail_device(*this,
                  fmt::format("{} degrees is outside its limits, {} to {}",
                              degrees(angle_rad),
                              degrees(info_.min_rad),
                              degrees(info_.max_rad)));
    }
    check_enabled();
    if (!homed_) fail_device(*this, "its angle is not known; home it first");
    unplugged_ = unplugged_ || faults_.triggers({"unplugged", degrees(angle_rad)});
    if (unplugged_) fail_device(*this, "does not answer; is its cable plugged in?");
    if (faults_.triggers({"alarm", degrees(angle_rad)})) {
      make_safe();
      fail_device(*this, "stopped with an alarm; see what blocks it, then home it");
    }
    if (faults_.triggers({"stuck", degrees(angle_rad)})) {
      make_safe();
      fail_device(
          *this,
          fmt::format("did not reach {} degrees in time; see what blocks it", degrees(angle_rad)));
    }
    deadline.sleep(move_time_s(angle_rad));
    if (deadline.passed()) {
      make_safe();
      fail_device(*this,
                  fmt::format("did not reach {} degrees within {:.3g} s; see what blocks it",
                              degrees(angle_rad),
                              deadline.timeout_s));
    }
    if (angle_rad < motor_rad_) turn_to(angle_rad - approach_rad_);
    turn_to(angle_rad);
  }
  [[nodiscard]] double move_time_s(double angle_rad) const override {
    return deg_per_s_ > 0.0 ? deg_from_rad(std::abs(angle_rad - motor_rad_)) / deg_per_s_ : 0.0;
  }

 private:
  void check_enabled() const {
    if (!enabled_) fail_device(*this, "is not enabled");
  }
  /// The turntable top lags the motor by the backlash when approached from above; the gear adds an
  /// error that depends on the angle.
  void turn_to(double angle_rad) {
    const double true_rad = angle_rad + offset_rad_;
    table_rad_ = std::clamp(table_rad_, true_rad, true_rad + backlash_rad_);
    motor_rad_ = angle_rad;
    const auto seed = static_cast<std::uint64_t>(std::llround(1e6 * true_rad));
    bench_->table_rad = table_rad_;
    if (seed != 0) bench_->table_rad += error_rad_ * normal_from(hash(hash(0x7AB1E), seed));
  }

  BenchPtr bench_;
  FaultScript faults_;
  TurntableInfo info_;
  double backlash_rad_;
  double approach_rad_;
  double error_rad_;
  double deg_per_s_;  ///< 0: moves take no time
  double motor_rad_ = 0.0;
  double table_rad_ = 0.0;
  double offset_rad_ = 0.0;  ///< true angle minus that of the motor; not 0 without a home switch
  bool enabled_ = false;
  bool homed_ = false;
  bool unplugged_ = false;
};

}  // namespace

std::unique_ptr<TurntableDevice> open_simulated_table(DeviceSettings& settings, BenchPtr bench) {
  return std::make_unique<SimulatedTable>(settings, std::move(bench));
}

}  // namespace frangia
