#pragma once

#include <cmath>

#include "frangia/core/angles.h"

namespace frangia {

/// The arc tangent of t in [0, 1] by an odd polynomial; error 3.6e-7 rad.
[[gnu::always_inline]] inline float fast_atan(float t) {
  const float t2 = t * t;
  // Estrin's scheme: independent products can be computed in parallel.
  const float t4 = t2 * t2;
  const float high = (0.0796236321F - 0.03360418592F * t2) + 0.006811781893F * t4;
  const float middle = (0.1980781497F - 0.1323333986F * t2) + t4 * high;
  return ((0.9999961115F - 0.3331736799F * t2) + t4 * middle) * t;
}

/// Extends the arc tangent of the smaller over the larger coordinate to [-pi, pi].
[[gnu::always_inline]] inline float restore_octant(float angle, float y, float x) {
  angle = std::fabs(y) > std::fabs(x) ? 0.5F * kPiF - angle : angle;
  angle = x < 0.0F ? kPiF - angle : angle;
  return std::copysign(angle, y);
}

/// Branch-free atan2, which the compiler vectorizes; 0 for (0, 0).
[[gnu::always_inline]] inline float fast_atan2(float y, float x) {
  const float ax = std::fabs(x);
  const float ay = std::fabs(y);
  const float large = ax > ay ? ax : ay;
  const float small = ax > ay ? ay : ax;
  return restore_octant(fast_atan(small / (large > 0.0F ? large : 1.0F)), y + 0.0F, x);  // no -0
}

}  // namespace frangia
