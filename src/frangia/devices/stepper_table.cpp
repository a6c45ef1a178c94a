#include "frangia/devices/stepper_table.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {

StepperTable::StepperTable(std::unique_ptr<TableFirmware> firmware,
                           const StepperTableOptions& options)
    : firmware_(std::move(firmware)), options_(options) {}

StepperTable::~StepperTable() {
  stop();
}

void StepperTable::stop() noexcept {
  angle_rad_.reset();
  firmware_->stop();
}

void StepperTable::home(const Deadline& deadline) {
  angle_rad_.reset();
  pushed_up_ = false;
  if (options_.home_switch) {
    firmware_->find_home(deadline);
  } else {
    firmware_->set_zero(deadline);
  }
  angle_rad_ = 0.0;
}

void StepperTable::move_to(double angle_rad, const Deadline& deadline) {
  const double angle_deg = deg_from_rad(angle_rad);
  if (!(angle_deg >= options_.least_deg && angle_deg <= options_.most_deg)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: {:.6g} degrees are outside the table's limits, {} to {}",
                            firmware_->name(),
                            angle_deg,
                            options_.least_deg,
                            options_.most_deg));
  }
  if (!angle_rad_) {
    fail_device(firmware_->name(), "the table's angle is not known; home it first");
  }
  // Until it is there, nobody knows where it is.
  const double from_deg = deg_from_rad(*std::exchange(angle_rad_, std::nullopt));
  // Every stop ends upwards, so that a further one upwards has no slack left to take.
  const double least_way_deg = pushed_up_ ? 0.0 : options_.backlash_deg;
  if (options_.backlash_deg > 0.0 && angle_deg - from_deg < least_way_deg) {
    go_to(angle_deg - options_.backlash_deg, deadline);
  }
  go_to(angle_deg, deadline);
  pushed_up_ = true;
  deadline.sleep(options_.settle_s);
  angle_rad_ = angle_rad;
}

void StepperTable::go_to(double angle_deg, const Deadline& deadline) {
  const double sign = options_.reversed ? -1.0 : 1.0;
  firmware_->go_to(sign * angle_deg * options_.units_per_degree,
                   options_.speed_deg_per_s * options_.units_per_degree,
                   deadline);
}

}  // namespace frangia
