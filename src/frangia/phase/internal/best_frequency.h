#pragma once

#include <span>

namespace frangia {

/// The frequency f for which the phases 2 pi f u at places `u` fit best; 0 if none fits.
///
/// `declared` is the expected frequency and `field` the range of the places.
///
/// @shape    one place and one phase per pixel
[[nodiscard]] double best_frequency(std::span<const double> places,
                                    std::span<const float> phases_rad,
                                    double declared,
                                    double field);

}  // namespace frangia
