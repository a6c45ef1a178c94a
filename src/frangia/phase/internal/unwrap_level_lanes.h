#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/core/angles.h"

namespace frangia {

/// The data of a level: a map or the beat of two maps.
struct LevelLanes {
  const float* phase;
  const float* subtracted;  ///< null for a single map
  const float* precision;
  const float* subtracted_precision;

  [[nodiscard]] bool is_beat() const { return subtracted != nullptr; }
};

// Bits of the state of a pixel's order.
inline constexpr std::int32_t kOrderUnsafe = 1;     ///< needs the exact probability
inline constexpr std::int32_t kOrderUncertain = 2;  ///< a single level exceeds the limit

/// Squared margins in sigmas, compared with half a fringe.
struct Margins {
  float safe;     ///< all levels together are within the limit
  float minimum;  ///< a single level is within the limit
};

/// The first level and its phase at the centre of the field.
struct FirstLevel {
  LevelLanes level;
  float center;
  Margins margins;
};

/// Unwraps the first level: no coarser level exists, but noise can wrap phases near the ends of the
/// single fringe. Sets `state` to the bits of each pixel.
void unwrap_first_level(const FirstLevel& first,
                        std::size_t n,
                        float* absolute,
                        std::int32_t* state);

/// A level and the next finer one.
struct LevelPair {
  LevelLanes coarse;
  LevelLanes fine;
  float ratio;  ///< ratio of their frequencies
  Margins margins;
};

/// Unwraps the next finer level by the scaled coarse one. Adds bits to `state`.
void unwrap_next_level(
    const LevelPair& pair, std::size_t n, const float* coarse, float* fine, std::int32_t* state);

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
