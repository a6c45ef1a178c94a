#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/find_ladder.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// The way up from one fringe over the field to the finest map, for many pixels at once.
class LadderClimb {
 public:
  /// errors   Error(Input) when empty, not coarse to fine, or without a common meaning
  LadderClimb(std::span<const Pattern> coarse_to_fine,
              const Projector& projector,
              double max_wrong_order);

  /// Wrapped phases and one over their variances, a pointer a map; `lost` is not 0 where one is
  /// missing.
  struct Input {
    std::span<const float* const> phase_rad;
    std::span<const float* const> precision;
    const std::int32_t* lost = nullptr;
  };
  /// Absolute phase of the finest map by the least-squares slope through all of them, and its
  /// sigma, of n pixels, at most kTilePixels; without meaning where lost. `doubtful` is 1 where the
  /// chance of a wrong order, summed over the steps, is above the limit, and 0 elsewhere.
  void climb(const Input& maps,
             std::size_t n,
             float* absolute_rad,
             float* sigma_rad,
             std::int32_t* doubtful) const;

 private:
  /// The least-squares slope of phase over frequency through all maps, the finest being `at`.
  void fit_slope(const Input& maps,
                 const float* at,
                 std::size_t n,
                 float* absolute_rad,
                 float* sigma_rad) const;
  /// The chance that one of pixel i's orders is wrong.
  [[nodiscard]] double wrong_chance(const Input& maps, std::size_t i) const;

  std::vector<LadderStep> steps_;
  std::vector<double> ratios_;  ///< of each map's fringes to the finest one's
  double max_wrong_order_;
  double safe_sigmas_;   ///< half a fringe away by so many sigmas is safe at each step
  double least_sigmas_;  ///< and by fewer than these is not, at any single one
  double centre_rad_;    ///< phase of the first step in the middle of the field
};

}  // namespace frangia
