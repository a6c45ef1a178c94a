#pragma once

#include <cmath>
#include <numbers>

namespace frangia {

inline constexpr double kPi = std::numbers::pi;              ///< half a turn
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;     ///< a whole turn; a fringe
inline constexpr auto kPiF = static_cast<float>(kPi);        ///< for single-precision loops
inline constexpr auto kTwoPiF = static_cast<float>(kTwoPi);  ///< for single-precision loops

/// Converts degrees to radians.
[[nodiscard]] constexpr double rad_from_deg(double deg) {
  return deg * (kPi / 180.0);
}
/// Converts radians to degrees.
[[nodiscard]] constexpr double deg_from_rad(double rad) {
  return rad * (180.0 / kPi);
}

/// Returns the equivalent angle in (-pi, pi].
///
/// @units    rad
[[nodiscard]] inline double wrap_rad(double angle_rad) {
  return angle_rad - kTwoPi * std::ceil((angle_rad - kPi) / kTwoPi);
}

}  // namespace frangia
