#pragma once

#include <span>

namespace frangia {

/// The RMS of the part of the errors of a map that repeats with once and twice its own phase: a
/// frame at another gain, under other light or with something else leaves it, harmonics do not.
///
/// @shape    for each pixel one phase of the map, its own or the one that other maps predict, and
///           the distance of its own from the predicted one; neighbours side by side
/// @units    rad
/// @return   0 where it is not significant
[[nodiscard]] double phase_ripple(std::span<const float> phases_rad,
                                  std::span<const double> errors_rad);

}  // namespace frangia
