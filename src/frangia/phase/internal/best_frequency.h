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

/// The natural logarithm of the odds that phases at `places` have the frequency `found`, of
/// `tried` ones, and not the declared one with any start.
///
/// All pixels at one place, such as at the border of two stripes, are one witness: they share the
/// error of the border.
///
/// @shape    one place and one phase per pixel
/// @source   Mardia and Jupp 2000, the wrapped Cauchy distribution, whose log likelihood is
///           -log(1 - R^2) per sample for the mean resultant length R
[[nodiscard]] double log_odds_of_frequency(std::span<const double> places,
                                           std::span<const float> phases_rad,
                                           double found,
                                           double declared,
                                           double tried);

}  // namespace frangia
