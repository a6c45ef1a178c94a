#include "frangia/devices/phase_shift_controller.h"

namespace frangia {

void PhaseShiftController::return_to_start(const Deadline& deadline) {
  command_ = shifter_.info().min_command;
  shifter_.drive(command_, deadline);
  started_ = true;
}

void PhaseShiftController::shift_to(double shift_rad, const Deadline& deadline) {
  const PhaseCurve& curve = shifter_.info().curve;
  const double command = curve.command_for(curve.phases_rad.front() + scale_ * shift_rad);
  if (!started_ || command < command_) return_to_start(deadline);
  shifter_.drive(command, deadline);
  command_ = command;
}

}  // namespace frangia
