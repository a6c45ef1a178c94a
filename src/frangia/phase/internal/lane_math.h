#pragma once

#include "frangia/core/angles.h"

namespace frangia {

/// Rounds numbers below four million to the nearest integer; vectorizes without a rounding
/// instruction.
[[gnu::always_inline]] inline float round_lane(float value) {
  constexpr float kShift = 12582912.0F;  // 1.5 * 2^23
  return (value + kShift) - kShift;
}

/// Returns the equivalent angle in [-pi, pi]; vectorizes.
[[gnu::always_inline]] inline float wrap_lane(float angle_rad) {
  constexpr auto kPerTwoPi = static_cast<float>(1.0 / kTwoPi);
  return angle_rad - kTwoPiF * round_lane(angle_rad * kPerTwoPi);
}

}  // namespace frangia
