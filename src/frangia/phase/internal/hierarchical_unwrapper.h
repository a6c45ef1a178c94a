#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/unwrap_levels.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// The way up from one fringe over the field to the finest map, for many pixels at once.
class HierarchicalUnwrapper {
 public:
  /// errors   Error(Input) when empty, not coarse to fine, or without a common meaning
  HierarchicalUnwrapper(std::span<const Pattern> coarse_to_fine,
                        const Projector& projector,
                        double max_wrong_order);

  /// Wrapped phases and one over their variances, a pointer a map; `invalid` is not 0 where one is
  /// missing.
  struct Input {
    std::span<const float* const> phase_rad;
    std::span<const float* const> precision;
    const std::int32_t* invalid = nullptr;
  };
  /// Absolute phase of the finest map by the least-squares slope through all of them, and its
  /// sigma, of n pixels, at most kTilePixels; without meaning where invalid. `uncertain` is 1 where
  /// the chance of a wrong order, summed over the steps, is above the limit, and 0 elsewhere.
  void unwrap(const Input& maps,
              std::size_t n,
              float* absolute_rad,
              float* sigma_rad,
              std::int32_t* uncertain) const;

 private:
  /// The least-squares slope of phase over frequency through all maps, the finest being `at`.
  void fit_slope(const Input& maps,
                 const float* at,
                 std::size_t n,
                 float* absolute_rad,
                 float* sigma_rad) const;
  /// The chance that one of pixel i's orders is wrong.
  [[nodiscard]] double pixel_wrong_order_probability(const Input& maps, std::size_t i) const;

  std::vector<UnwrapLevel> levels_;
  std::vector<double> ratios_;  ///< of each map's fringes to the finest one's
  double max_wrong_order_;
  double safe_sigmas_ = 0.0;  ///< half a fringe away by so many sigmas is safe at each step
  double min_sigmas_;         ///< and by fewer than these is not, at any single one
  double center_rad_ = 0.0;   ///< phase of the first step in the middle of the field
};

}  // namespace frangia
