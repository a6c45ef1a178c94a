#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// One level of hierarchical unwrapping: a map or the beat of two maps.
struct UnwrapLevel {
  std::size_t map = 0;    ///< index of the map
  int subtracted = -1;    ///< index of the subtracted map; -1 for none
  double per_unit = 0.0;  ///< fringes per degree or projector pixel
};

/// Finds the levels from one fringe over the field to the finest map. Each level is the finest that
/// is safe for noise `sigma_rad` in every map; empty when the maps do not determine an absolute
/// phase.
///
/// @shape    patterns coarse to fine
/// @units    rad
[[nodiscard]] std::vector<UnwrapLevel> find_unwrap_levels(std::span<const Pattern> patterns,
                                                          const Projector& projector,
                                                          double sigma_rad = 0.05);

/// Returns whether every level has a probability of a wrong order below `max_wrong_order` for noise
/// `sigma_rad` in every map.
[[nodiscard]] bool is_safe(std::span<const UnwrapLevel> levels,
                           double sigma_rad,
                           double max_wrong_order);

}  // namespace frangia
