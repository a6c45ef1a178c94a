#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/internal/tile_phases.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Searches all fringe orders of the finest map for the most likely one, given the wrapped phases
/// of all maps. Any frequencies will do whose combination is unique over the field: beats, beats of
/// beats, narrow bands.
class OrderSearch {
 public:
  /// @errors   Error(Input) when empty, not coarse to fine, or when the maps do not determine the
  ///           order
  OrderSearch(std::span<const Pattern> coarse_to_fine,
              const Projector& projector,
              double max_wrong_order);

  /// Computes the same as `HierarchicalUnwrapper::unwrap`. The probability of a wrong order is that
  /// of the second most likely one, from the difference of their squared residuals over sigma.
  void unwrap(const TilePhases& maps,
              std::size_t n,
              float* absolute_rad,
              float* sigma_rad,
              std::int32_t* uncertain) const;

 private:
  std::vector<double> ratios_;  ///< frequency of each map relative to the finest one
  double min_rad_ = 0.0;        ///< phases of the finest map at the ends of the field
  double max_rad_ = 0.0;
  float min_difference_ = 0.0F;  ///< of squared residuals; a smaller one is uncertain
};

}  // namespace frangia
