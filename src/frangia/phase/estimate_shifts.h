#pragma once

#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// The shift that each frame really has.
struct ShiftEstimate {
  std::vector<double> shifts_rad;  ///< the pattern's own when not `found`
  double residual_counts2 = 0.0;   ///< variance left over, for each degree of freedom
  double expected_counts2 = 0.0;   ///< that of the camera's noise at the same brightness
  /// Whether the frames fit the shifts to within the noise. With few fringes or too much else going
  /// on they do not, and the shifts are not to be trusted.
  bool found = false;
};

/// Unequal unknown shifts, by least squares in the phases of all pixels and the shifts of all
/// frames at once. Mean and modulation are each pixel's own, so that an uneven envelope does no
/// harm. Only differences of shifts can be seen: as a whole they are placed so that the pattern's,
/// scaled, fit them best, which is exact for a shifter whose gain is off.
///
/// errors   Error(Input) for fewer than six frames
/// source   AIA, Wang and Han 2004, whose iteration is replaced by one that converges
[[nodiscard]] ShiftEstimate estimate_shifts(const FrameStack& stack, const NoiseModel& noise);

}  // namespace frangia
