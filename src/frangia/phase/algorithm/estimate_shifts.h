#pragma once

#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// The actual shift of each frame.
struct ShiftEstimate {
  std::vector<double> shifts_rad;  ///< nominal shifts unless `found`
  double residual_counts2 = 0.0;   ///< residual variance per degree of freedom
  double expected_counts2 = 0.0;   ///< variance of the camera noise at the mean brightness
  /// Whether the residual is consistent with noise. It is not with too few fringes, motion or
  /// flicker; the shifts are then unreliable.
  bool found = false;
};

/// Estimates unequal unknown shifts by least squares in the phases of all pixels and the shifts of
/// all frames jointly. Each pixel has its own mean and modulation, so uneven illumination does not
/// matter. Only differences of shifts are observable; the common offset is chosen such that the
/// scaled nominal shifts fit best, which is exact for a phase shifter with a gain error.
///
/// With n frames it takes n^2 operations for each of up to 20000 sampled pixels, and n^3 / 6 for
/// each iteration, which is less for the 360 frames of the longest sequence.
///
/// @errors   Error(Input) for fewer than six frames
/// @source   AIA, Wang and Han 2004; a Levenberg-Marquardt iteration replaces the alternation
[[nodiscard]] ShiftEstimate estimate_shifts(const FrameStack& stack, const NoiseModel& noise);

}  // namespace frangia
