#pragma once

#include "frangia/devices/phase_shifter.h"

namespace frangia {

/// Brings fringes to a phase through a phase shifter: by its curve, with a correction for what the
/// frames have shown of it, and always from below, so that hysteresis does no harm.
class PhaseShiftController {
 public:
  explicit PhaseShiftController(PhaseShifter& shifter) : shifter_(shifter) {}

  /// To the lowest command: every set of frames begins from there.
  void return_to_start(const Deadline& deadline);

  /// To a shift from the phase at rest; by way of rest when that is below the last one.
  /// units    rad
  /// errors   Error(Device) as the shifter; Error(Input) when its curve does not span the shift
  void shift_to(double shift_rad, const Deadline& deadline);

  /// The factor on all shifts asked for; 1 at first.
  [[nodiscard]] double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }

 private:
  PhaseShifter& shifter_;
  double scale_ = 1.0;
  double command_ = 0.0;
  bool started_ = false;
};

}  // namespace frangia
