#include "frangia/devices/internal/board_devices.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {

StepperTurntable::StepperTurntable(std::shared_ptr<MotionController> board,
                                   const StepperTurntableOptions& options)
    : board_(std::move(board)), options_(options) {}

StepperTurntable::~StepperTurntable() {
  make_safe();
}

std::string StepperTurntable::test(const Deadline& deadline) {
  const std::string answer = board_->identify(deadline);
  if (std::string differs = board_->difference(deadline); !differs.empty())
    warnings_.push_back(std::move(differs));
  return answer;
}

void StepperTurntable::make_safe() noexcept {
  const std::scoped_lock lock(board_->mutex());
  angle_rad_.reset();
  enabled_ = false;
  board_->stop();
}

void StepperTurntable::enable(bool on, const Deadline& deadline) {
  enabled_ = false;
  if (!on) angle_rad_.reset();
  board_->enable_motor(on, deadline);
  if (std::string changed = board_->take_change(); !changed.empty())
    warnings_.push_back(std::move(changed));
  enabled_ = on;
}

void StepperTurntable::home(const Deadline& deadline) {
  if (!enabled_) fail_device(*this, "it is not enabled; enable it before homing");
  if (!options_.info.can_home) return set_angle(0.0, deadline);
  angle_rad_.reset();
  backlash_taken_up_ = false;
  board_->home(deadline);
  zero_deg_ = 0.0;
  stop_count_ = board_->stop_count();
  angle_rad_ = 0.0;
}

void StepperTurntable::set_angle(double angle_rad, const Deadline& deadline) {
  if (!enabled_) fail_device(*this, "it is not enabled; enable it before setting its angle");
  angle_rad_.reset();
  backlash_taken_up_ = false;
  board_->set_zero(deadline);
  zero_deg_ = deg_from_rad(angle_rad);
  stop_count_ = board_->stop_count();
  angle_rad_ = angle_rad;
}

std::optional<double> StepperTurntable::angle_rad() const {
  // A lamp on the same board may have stopped the board.
  return stop_count_ == board_->stop_count() ? angle_rad_ : std::nullopt;
}

void StepperTurntable::move_to(double angle_rad, const Deadline& deadline) {
  check_target(angle_rad);
  const double target_deg = deg_from_rad(angle_rad);
  // The angle is unknown until the move has ended.
  const double from_deg = deg_from_rad(*std::exchange(angle_rad_, std::nullopt));
  // Every move ends upwards, so a further upward move meets no backlash.
  const double min_travel_deg = backlash_taken_up_ ? 0.0 : options_.backlash_deg;
  if (options_.backlash_deg > 0.0 && target_deg - from_deg < min_travel_deg) {
    command_angle(target_deg - options_.backlash_deg, deadline);
  }
  command_angle(target_deg, deadline);
  backlash_taken_up_ = true;
  deadline.sleep(options_.settle_s);
  angle_rad_ = angle_rad;
}

double StepperTurntable::move_time_s(double angle_rad) const {
  const std::optional<double> from_rad = this->angle_rad();
  if (!from_rad) return options_.settle_s;
  const double way_deg =
      std::abs(deg_from_rad(angle_rad - *from_rad)) + 2.0 * options_.backlash_deg;
  const double scale = options_.units_per_degree;
  // A move that takes up backlash stops twice.
  const double stop_s = board_->move_time_s(0.0, options_.speed_deg_per_s * scale);
  return board_->move_time_s(way_deg * scale, options_.speed_deg_per_s * scale) + stop_s +
         options_.settle_s;
}

double StepperTurntable::home_time_s() const {
  if (!options_.info.can_home) return 0.0;
  const double reported_s = board_->home_time_s();
  return reported_s > 0.0 ? reported_s : options_.home_time_s;
}

void StepperTurntable::check_target(double angle_rad) const {
  if (!(angle_rad >= options_.info.min_rad && angle_rad <= options_.info.max_rad)) {
    fail_device(*this,
                fmt::format("{:.6g} degrees are outside its limits, {:.6g} to {:.6g}",
                            deg_from_rad(angle_rad),
                            deg_from_rad(options_.info.min_rad),
                            deg_from_rad(options_.info.max_rad)));
  }
  if (!enabled_) fail_device(*this, "it is not enabled; enable it first");
  if (!this->angle_rad()) fail_device(*this, "its angle is unknown; home it first");
}

void StepperTurntable::command_angle(double angle_deg, const Deadline& deadline) {
  const double sign = options_.reversed ? -1.0 : 1.0;
  board_->move_to(sign * (angle_deg - zero_deg_) * options_.units_per_degree,
                  options_.speed_deg_per_s * options_.units_per_degree,
                  deadline);
}

BoardSwitch::BoardSwitch(std::shared_ptr<MotionController> board, std::string on, std::string off)
    : board_(std::move(board)), on_command_(std::move(on)), off_command_(std::move(off)) {
  board_->add_off_command(off_command_);
}

BoardSwitch::~BoardSwitch() {
  make_safe();
}

std::string BoardSwitch::test(const Deadline& deadline) {
  return board_->identify(deadline);
}

void BoardSwitch::make_safe() noexcept {
  constexpr double kAnswer_s = 0.3;  // boards at rest answer within 10 ms
  const std::scoped_lock lock(board_->mutex());
  if (!is_on()) return;
  try {
    set(false, Deadline::in(kAnswer_s));
  } catch (const Error&) {
    board_->stop();
    on_ = false;
  }
}

void BoardSwitch::set(bool on, const Deadline& deadline) {
  stop_count_ = board_->stop_count();
  on_ = true;  // assume on until the board acknowledges off
  board_->command(on ? on_command_ : off_command_, deadline);
  on_ = on;
}

}  // namespace frangia
