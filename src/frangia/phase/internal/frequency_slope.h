#pragma once

#include <cstddef>
#include <span>

namespace frangia {

/// Wrapped phases and their inverse variances of up to kTilePixels pixels, one pointer per map, and
/// the frequency of each map relative to the finest one.
struct FrequencyMaps {
  std::span<const float* const> phase_rad;
  std::span<const float* const> precision;
  std::span<const double> ratios;
};

/// Fits the weighted least-squares slope of phase over frequency through all maps. `at` is the
/// absolute phase of the finest map; the slope gives a more precise one and its sigma.
///
/// @source   Huntley and Saldner 1997
void fit_frequency_slope(const FrequencyMaps& maps,
                         const float* at,
                         std::size_t n,
                         float* absolute_rad,
                         float* sigma_rad);

}  // namespace frangia
