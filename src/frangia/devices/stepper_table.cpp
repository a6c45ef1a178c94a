#include "frangia/devices/stepper_table.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {

StepperTable::StepperTable(std::shared_ptr<TableFirmware> board, const StepperTableOptions& options)
    : board_(std::move(board)), options_(options) {}

StepperTable::~StepperTable() {
  make_safe();
}

std::string StepperTable::test(const Deadline& deadline) {
  return board_->identify(deadline);
}

void StepperTable::make_safe() noexcept {
  angle_rad_.reset();
  enabled_ = false;
  board_->stop();
}

void StepperTable::enable(bool on, const Deadline& deadline) {
  enabled_ = false;
  if (!on) angle_rad_.reset();
  board_->hold_motor(on, deadline);
  enabled_ = on;
}

void StepperTable::home(const Deadline& deadline) {
  if (!enabled_) device_fault(*this, "it is not enabled and cannot look for its home");
  angle_rad_.reset();
  pushed_up_ = false;
  if (options_.info.can_home) {
    board_->find_home(deadline);
  } else {
    board_->set_zero(deadline);
  }
  stops_ = board_->stops();
  angle_rad_ = 0.0;
}

std::optional<double> StepperTable::angle_rad() const {
  // A lamp on the same board may have stopped it.
  return stops_ == board_->stops() ? angle_rad_ : std::nullopt;
}

void StepperTable::move_to(double angle_rad, const Deadline& deadline) {
  check_target(angle_rad);
  const double target_deg = deg_from_rad(angle_rad);
  // Until it is there, nobody knows where it is.
  const double from_deg = deg_from_rad(*std::exchange(angle_rad_, std::nullopt));
  // Every stop ends upwards, so that a further one upwards has no slack left to take.
  const double least_way_deg = pushed_up_ ? 0.0 : options_.backlash_deg;
  if (options_.backlash_deg > 0.0 && target_deg - from_deg < least_way_deg) {
    go_to(target_deg - options_.backlash_deg, deadline);
  }
  go_to(target_deg, deadline);
  pushed_up_ = true;
  deadline.sleep(options_.settle_s);
  angle_rad_ = angle_rad;
}

void StepperTable::check_target(double angle_rad) const {
  if (!(angle_rad >= options_.info.min_rad && angle_rad <= options_.info.max_rad)) {
    device_fault(*this,
                 fmt::format("{:.6g} degrees are outside its limits, {:.6g} to {:.6g}",
                             deg_from_rad(angle_rad),
                             deg_from_rad(options_.info.min_rad),
                             deg_from_rad(options_.info.max_rad)));
  }
  if (!enabled_) device_fault(*this, "it is not enabled");
  if (!this->angle_rad()) device_fault(*this, "its angle is not known; home it first");
}

void StepperTable::go_to(double angle_deg, const Deadline& deadline) {
  const double sign = options_.reversed ? -1.0 : 1.0;
  board_->go_to(sign * angle_deg * options_.units_per_degree,
                options_.speed_deg_per_s * options_.units_per_degree,
                deadline);
}

}  // namespace frangia
