#include "frangia/acquisition/internal/table_mover.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Rounded to a millionth of a degree, so that the manifest holds no rounding errors of radians.
double rounded_deg(double angle_rad) {
  return std::round(1e6 * deg_from_rad(angle_rad)) / 1e6 + 0.0;
}

/// States the last known angle of a table and how to continue.
std::string unknown_angle(const TableRecord& last) {
  const std::string begin =
      "has no home switch, and may have been turned since the last session of this scan";
  if (!last.intended_deg && last.reached_deg) {
    return fmt::format(
        "{}, which left it at {:.6g} degrees; if it still stands there, set "
        "`table_at_rad` to {:.6g}, otherwise turn it to 0 by hand and set "
        "`table_at_rad` to 0",
        begin,
        *last.reached_deg,
        *last.reached_deg);
  }
  const std::string from =
      last.reached_deg ? fmt::format(" from {:.6g}", *last.reached_deg) : std::string();
  return fmt::format(
      "{}, which ended while it turned{} to {:.6g} degrees; turn it to 0 by hand and "
      "set `table_at_rad` to 0",
      begin,
      from,
      last.intended_deg.value_or(0.0));
}

}  // namespace

void TableMover::turn_to(double angle_rad) {
  if (table_ == nullptr || standing_rad_ == angle_rad) return;
  establish_angle();
  standing_rad_.reset();
  manifest_.add_table_move(rounded_deg(angle_rad));
  devices_.turn_to(angle_rad);
  manifest_.add_table_at(rounded_deg(angle_rad));
  standing_rad_ = angle_rad;
}

void TableMover::return_to_zero() {
  if (!standing_rad_ || table_->info().min_rad > 0.0 || table_->info().max_rad < 0.0) return;
  devices_.darken();
  turn_to(0.0);
}

void TableMover::establish_angle() {
  if (angle_established_) return;
  if (table_->info().can_home) {
    if (table_at_rad_)
      throw Error(ErrorKind::Input,
                  fmt::format("{}: finds its angle with its home switch; leave `table_at_rad` out",
                              table_->name()));
  } else if (table_at_rad_) {
    const TableRecord& last = manifest_.table();
    const double stated_deg = rounded_deg(*table_at_rad_);
    if (last.reached_deg && !last.intended_deg && *last.reached_deg != stated_deg) {
      run_.warn(
          fmt::format("{}: the last session left it at {:.6g} degrees, and `table_at_rad` is "
                      "{:.6g}; this is right only if it was turned since",
                      table_->name(),
                      *last.reached_deg,
                      stated_deg));
    }
    devices_.set_table_angle(*table_at_rad_);
  } else if (const TableRecord& last = manifest_.table(); last.reached_deg || last.intended_deg) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", table_->name(), unknown_angle(last)));
  } else {
    devices_.set_table_angle(0.0);
  }
  angle_established_ = true;
}

}  // namespace frangia
