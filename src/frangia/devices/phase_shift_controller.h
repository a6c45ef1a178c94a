#pragma once

#include "frangia/devices/phase_shifter.h"

namespace frangia {

/// Sets phase shifts through a phase shifter with its curve and a correction factor from the
/// measured shifts. Approaches every command from below to avoid hysteresis.
class PhaseShiftController {
 public:
  /// `shifter` must outlive the controller.
  explicit PhaseShiftController(PhaseShifter& shifter) : shifter_(shifter) {}

  /// Drives to the lowest command, where every set of frames starts.
  void return_to_start(const Deadline& deadline);

  /// Drives to a shift from the phase at rest; from rest when the shift is below the previous one.
  ///
  /// @units    rad
  /// @errors   Error(Device) as the shifter; Error(Input) when its curve does not contain the shift
  void shift_to(double shift_rad, const Deadline& deadline);

  /// Sets the factor on all requested shifts; initially 1.
  [[nodiscard]] double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }  ///< see `scale`

 private:
  PhaseShifter& shifter_;
  double scale_ = 1.0;
  double command_ = 0.0;
  bool started_ = false;
};

}  // namespace frangia
