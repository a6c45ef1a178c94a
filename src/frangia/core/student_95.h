#pragma once

#include <algorithm>
#include <cmath>

namespace frangia {

/// Half the width of the 95 % interval of a normal distribution, in standard deviations.
inline constexpr double kNormal95 = 1.959964;

/// Student's factor of a 95 % interval; within 0.3 % from 4 degrees of freedom. Fewer than 1 count
/// as 1.
///
/// @source   Abramowitz and Stegun 1964, 26.7.5
[[nodiscard]] inline double student_95(double degrees_of_freedom) {
  constexpr double z = kNormal95;
  const double n = std::max(degrees_of_freedom, 1.0);
  return z + (std::pow(z, 3) + z) / (4.0 * n) +
         (5.0 * std::pow(z, 5) + 16.0 * std::pow(z, 3) + 3.0 * z) / (96.0 * n * n) +
         (3.0 * std::pow(z, 7) + 19.0 * std::pow(z, 5) + 17.0 * std::pow(z, 3) - 15.0 * z) /
             (384.0 * n * n * n);
}

}  // namespace frangia
