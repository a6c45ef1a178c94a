#pragma once

#include <cstddef>
#include <span>

#include "frangia/phase/internal/wrap_tile.h"

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

/// Fits the weighted least-squares slope of phase over frequency through all maps. `ratios` are the
/// frequencies of the maps relative to the finest one. `at` is the absolute phase of the finest
/// map; the slope gives a more precise one and its sigma.
///
/// @source   Huntley and Saldner 1997
void fit_frequency_slope(const TilePhases& maps,
                         std::span<const double> ratios,
                         const float* at,
                         std::size_t n,
                         float* absolute_rad,
                         float* sigma_rad);

}  // namespace frangia
