#pragma once

#include <cstddef>
#include <span>

#include "frangia/phase/internal/tile_phases.h"

namespace frangia {

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
