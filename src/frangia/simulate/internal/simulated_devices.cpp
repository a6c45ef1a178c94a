#include "frangia/simulate/internal/simulated_devices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/simulate/internal/fault_script.h"

namespace frangia {
namespace {

class SimulatedDisplay final : public PatternDisplay {
 public:
  SimulatedDisplay(DeviceSettings& settings, const Rig& rig, BenchPtr bench)
      : bench_(std::move(bench)) {
    const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
    if (pinhole == nullptr) settings.fail("driver", "is a digital projector, but the rig has none");
    layout_ = rig.projector.pixels;
    const std::array<int, 2> size = image_size(layout_, pinhole->width_px, pinhole->height_px);
    info_.width_px = size[0];
    info_.height_px = size[1];
    if (const double rate_hz = settings.number_or("refresh_hz", 0.0, 0.0, 1000.0); rate_hz > 0.0)
      info_.refresh_period_ms = 1000.0 / rate_hz;
    latency_s_ = 1e-3 * settings.number_or("latency_ms", 0.0, 0.0, 10'000.0);
    delay_s_ = settings.number_or("delay_s", 0.0, 0.0, 10.0);
  }

  [[nodiscard]] std::string name() const override { return "simulated display"; }
  [[nodiscard]] const DisplayInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return fmt::format("{} x {} pixels", info_.width_px, info_.height_px);
  }
  void make_safe() noexcept override { bench_->pictures.assign(1, {}); }
  void show(const Image<float>& light, const Deadline& deadline) override {
    deadline.check();
    const double period_s = 1e-3 * info_.refresh_period_ms;
    double& clock_s = bench_->clock_s;
    if (period_s > 0.0) clock_s = period_s * std::ceil(clock_s / period_s);
    auto& pictures = bench_->pictures;
    pictures.push_back(
        {clock_s + latency_s_, layout_ == PixelLayout::Square ? light : on_chip(light)});
    clock_s += delay_s_;
    while (pictures.size() > 1 && pictures[1].from_s <= clock_s)
      pictures.erase(pictures.begin());
  }
  void show_dark(const Deadline& /*deadline*/) override { bench_->pictures.assign(1, {}); }
  [[nodiscard]] double delay_s() const override { return delay_s_; }
  void set_delay(double seconds) override { delay_s_ = seconds; }

 private:
  /// The light at every place of a chip with diamond pixels; each pixel lights two places of its
  /// row.
  static Image<float> on_chip(const Image<float>& image) {
    Image<float> chip(2 * image.width(), image.height(), 0.0F);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const int column = chip_column(PixelLayout::Diamond, x, y);
        chip(column, y) = image(x, y);
        if (column + 1 < chip.width()) chip(column + 1, y) = image(x, y);
      }
    }
    return chip;
  }

  BenchPtr bench_;
  DisplayInfo info_;
  double latency_s_ = 0.0;  ///< from the buffer swap until a picture is on the screen
  double delay_s_ = 0.0;
  PixelLayout layout_ = PixelLayout::Square;
};

class SimulatedSwitch final : public SwitchDevice {
 public:
  SimulatedSwitch(BenchPtr bench, bool SimulatedBench::*light)
      : bench_(std::move(bench)), light_(light) {
    (*bench_).*light_ = false;
  }
  [[nodiscard]] std::string name() const override {
    return light_ == &SimulatedBench::line_light ? "simulated laser sheet" : "simulated light";
  }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return is_on() ? "on" : "off";
  }
  void make_safe() noexcept override { (*bench_).*light_ = false; }
  void set(bool on, const Deadline& /*deadline*/) override { (*bench_).*light_ = on; }
  [[nodiscard]] bool is_on() const override { return (*bench_).*light_; }

 private:
  BenchPtr bench_;
  bool SimulatedBench::*light_;
};

}  // namespace

std::unique_ptr<PatternDisplay> open_simulated_display(DeviceSettings& settings,
                                                       const Rig& rig,
                                                       BenchPtr bench) {
  return std::make_unique<SimulatedDisplay>(settings, rig, std::move(bench));
}

std::unique_ptr<SwitchDevice> open_simulated_switch(BenchPtr bench, bool SimulatedBench::*light) {
  return std::make_unique<SimulatedSwitch>(std::move(bench), light);
}

namespace {

class SimulatedPiezo final : public PhaseShifter {
 public:
  SimulatedPiezo(DeviceSettings& settings, BenchPtr bench)
      : bench_(std::move(bench)),
        gain_(1.0 + settings.number_or("gain_error", 0.0, -0.9, 0.9)),
        nonlinearity_(settings.number_or("nonlinearity", 0.0, -0.5, 0.5)),
        hysteresis_(settings.number_or("hysteresis", 0.0, 0.0, 1e4)) {
    info_.min_command = settings.number_or("min_command", 0.0);
    info_.max_command = settings.number_or("max_command", 12.0);
    if (!(info_.min_command < info_.max_command))
      settings.fail("min_command", "must be below max_command");
    info_.curve = read_phase_curve(settings, info_.min_command, info_.max_command);
    info_.fringes_per_degree = settings.number_or("fringes_per_degree", 0.0, 0.0, 1e4);
    true_command_per_turn_ =
        settings.number_or("true_command_per_turn", nominal_command_per_turn(), 1e-6, 1e6);
    const double lag_s = settings.number_or("time_constant_s", 0.001, 0.0, 10.0);
    const double settle_s = settings.number_or("settle_s", 0.02, 0.0, 10.0);
    unsettled_share_ = lag_s > 0.0 ? std::exp(-settle_s / lag_s) : 0.0;
    if (info_.fringes_per_degree > 0.0) bench_->fringes_per_degree = info_.fringes_per_degree;
    bench_->drift_rad_per_view = rad_from_deg(settings.number_or("drift_deg_per_view", 0.0));
    bench_->jitter_rad = rad_from_deg(settings.number_or("jitter_deg", 0.0, 0.0, 180.0));
    go(info_.min_command, 0.0);
  }

  [[nodiscard]] std::string name() const override { return "simulated piezo"; }
  [[nodiscard]] const ShifterInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return fmt::format("{:g} to {:g} {}", info_.min_command, info_.max_command, info_.unit);
  }
  void make_safe() noexcept override { go(info_.min_command, 0.0); }

  void drive(double command, const Deadline& deadline) override {
    deadline.check();
    check_command(command);
    go(command,
       command == info_.min_command
           ? 0.0
           : unsettled_share_);  // a return to the start waits until settled
  }

  void set_fringe_frequency(double fringes_per_degree, const Deadline& deadline) override {
    PhaseShifter::set_fringe_frequency(fringes_per_degree, deadline);
    bench_->fringes_per_degree = fringes_per_degree;
  }

 private:
  /// Command per 2 pi of the nominal curve.
  [[nodiscard]] double nominal_command_per_turn() const {
    const PhaseCurve& curve = info_.curve;
    return kTwoPi * (curve.commands.back() - curve.commands.front()) /
           std::abs(curve.phases_rad.back() - curve.phases_rad.front());
  }

  void go(double command, double lag) noexcept {
    const double target = std::clamp(position_, command, command + hysteresis_);
    position_ = command == info_.min_command ? command : target + lag * (position_ - target);
    const double travel = position_ - info_.min_command;
    const double share = travel / (info_.max_command - info_.min_command);
    bench_->piezo_rad =
        gain_ * kTwoPi * travel / true_command_per_turn_ * (1.0 + nonlinearity_ * share);
  }

  BenchPtr bench_;
  ShifterInfo info_;
  double gain_;
  double nonlinearity_;  ///< relative increase of the phase per command at the end of the range
  double hysteresis_;    ///< of the hysteresis, in commands
  double true_command_per_turn_ = 1.0;
  double unsettled_share_ = 0.0;
  double position_ = 0.0;
};

}  // namespace

std::unique_ptr<PhaseShifter> open_simulated_piezo(DeviceSettings& settings, BenchPtr bench) {
  return std::make_unique<SimulatedPiezo>(settings, std::move(bench));
}

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
