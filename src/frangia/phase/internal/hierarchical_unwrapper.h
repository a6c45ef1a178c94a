#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Hierarchical temporal unwrapping from one fringe over the field to the finest map, for many
/// pixels at once.
class HierarchicalUnwrapper {
 public:
  /// @errors   Error(Input) when empty, not coarse to fine, or when the maps do not determine an
  ///          absolute phase
  HierarchicalUnwrapper(std::span<const Pattern> coarse_to_fine,
                        const Projector& projector,
                        double max_wrong_order);

  /// Computes the absolute phase of the finest map by the least-squares slope through all maps, and
  /// its sigma, for n <= kTilePixels pixels. Results are meaningless where a phase is missing.
  /// `uncertain` is 1 where the probability of a wrong order, summed over the levels, exceeds the
  /// limit, and 0 elsewhere.
  void unwrap(const TilePhases& maps,
              std::size_t n,
              float* absolute_rad,
              float* sigma_rad,
              std::int32_t* uncertain) const;

 private:
  /// Probability that one of pixel i's orders is wrong.
  [[nodiscard]] double pixel_wrong_order_probability(const TilePhases& maps, std::size_t i) const;

  std::vector<UnwrapLevel> levels_;
  std::vector<double> ratios_;  ///< frequency of each map relative to the finest one
  double max_wrong_order_;
  double safe_sigmas_ = 0.0;  ///< a margin of this many sigmas is safe at every level
  double min_sigmas_;         ///< a margin of fewer sigmas is unsafe at a single level
  double center_rad_ = 0.0;   ///< phase of the first level at the centre of the field
};

}  // namespace frangia
