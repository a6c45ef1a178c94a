#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/simulated_devices.h"

namespace frangia {
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

}  // namespace frangia
