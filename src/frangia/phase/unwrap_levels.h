#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// One step from a coarse phase to a finer one: a map of its own, or the beat of two.
struct UnwrapLevel {
  std::size_t map = 0;    ///< index of the map
  int subtracted = -1;    ///< index of the map taken off it; -1 for none
  double per_unit = 0.0;  ///< fringes per degree or projector pixel
};

/// The way from one fringe over the field, of a map or of a beat of two, to the finest map, each
/// step as fine as noise `sigma_rad` in every map allows. Empty when there is none.
[[nodiscard]] std::vector<UnwrapLevel> find_unwrap_levels(std::span<const Pattern> patterns,
                                                          const Projector& projector,
                                                          double sigma_rad = 0.05);

/// Whether each step of the ladder, with noise `sigma_rad` in every map, goes to a wrong fringe
/// with less than this chance.
[[nodiscard]] bool is_safe(std::span<const UnwrapLevel> levels,
                           double sigma_rad,
                           double max_wrong_order);

}  // namespace frangia
