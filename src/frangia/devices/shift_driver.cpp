#include "frangia/devices/shift_driver.h"

namespace frangia {

void ShiftDriver::rest(const Deadline& deadline) {
  command_ = shifter_.info().min_command;
  shifter_.drive(command_, deadline);
  rested_ = true;
}

void ShiftDriver::go_to(double shift_rad, const Deadline& deadline) {
  const PhaseCurve& curve = shifter_.info().curve;
  const double command = curve.command_for(curve.phases_rad.front() + scale_ * shift_rad);
  if (!rested_ || command < command_) rest(deadline);
  shifter_.drive(command, deadline);
  command_ = command;
}

}  // namespace frangia
