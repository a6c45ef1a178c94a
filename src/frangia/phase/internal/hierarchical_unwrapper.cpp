#include "frangia/phase/internal/hierarchical_unwrapper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/internal/fringe_frequency.h"
#include "frangia/phase/internal/unwrap_level_lanes.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Returns whether any element is nonzero.
FRANGIA_VECTORIZED bool any_of(const std::int32_t* state, std::size_t n) {
  std::int32_t all = 0;
  for (std::size_t i = 0; i < n; ++i)
    all |= state[i];
  return all != 0;
}

/// The data of a level; `subtracted` is null for a single map.
LevelLanes lanes_of(const UnwrapLevel& step, const TilePhases& maps) {
  if (step.subtracted < 0)
    return {maps.phase_rad[step.map], nullptr, maps.precision[step.map], nullptr};
  const auto subtracted = static_cast<std::size_t>(step.subtracted);
  return {maps.phase_rad[step.map],
          maps.phase_rad[subtracted],
          maps.precision[step.map],
          maps.precision[subtracted]};
}

}  // namespace

HierarchicalUnwrapper::HierarchicalUnwrapper(std::span<const Pattern> coarse_to_fine,
                                             const Projector& projector,
                                             double max_wrong_order)
    : max_wrong_order_(max_wrong_order),
      min_sigmas_(kPi / sigma_for_wrong_order_probability(max_wrong_order)) {
  require(!coarse_to_fine.empty(), "unwrap_sequence: no phase given");
  const double top = coarse_to_fine.back().fringes_per_unit();
  for (const Pattern& pattern : coarse_to_fine) {
    require(std::isfinite(pattern.fringes_per_unit()) && pattern.fringes_per_unit() > 0.0 &&
                pattern.fringes_per_unit() >= coarse_to_fine.front().fringes_per_unit() &&
                pattern.fringes_per_unit() <= top,
            "unwrap_sequence: the phases must go from coarse to fine");
    ratios_.push_back(pattern.fringes_per_unit() / top);
  }
  levels_ = find_unwrap_levels(coarse_to_fine, projector);
  require(!levels_.empty(),
          "the fringe patterns do not determine an absolute phase: none of them, and no beat of "
          "two, has at most one fringe over the field");
  const auto count = static_cast<double>(levels_.size());
  safe_sigmas_ = kPi / sigma_for_wrong_order_probability(max_wrong_order / count);
  center_rad_ =
      levels_.front().per_unit / top * phase_range(coarse_to_fine.back(), projector).center_rad();
}

void HierarchicalUnwrapper::unwrap(const TilePhases& maps,
                                   std::size_t n,
                                   float* absolute_rad,
                                   float* sigma_rad,
                                   std::int32_t* uncertain) const {
  alignas(64) std::array<Lane, 2> lanes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const Margins margins{static_cast<float>(safe_sigmas_ * safe_sigmas_),
                        static_cast<float>(min_sigmas_ * min_sigmas_)};
  LevelLanes coarse = lanes_of(levels_.front(), maps);
  unwrap_first_level(
      {coarse, static_cast<float>(center_rad_), margins}, n, lanes[0].data(), uncertain);
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const LevelLanes fine = lanes_of(levels_[k], maps);
    const double ratio = levels_[k].per_unit / levels_[k - 1].per_unit;
    unwrap_next_level({coarse, fine, static_cast<float>(ratio), margins},
                      n,
                      lanes[(k - 1) % 2].data(),
                      lanes[k % 2].data(),
                      uncertain);
    coarse = fine;
  }
  fit_frequency_slope(
      maps, ratios_, lanes[(levels_.size() - 1) % 2].data(), n, absolute_rad, sigma_rad);
  // Pixels that the margins do not classify as safe get the exact probability.
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < n; begin += kBlock) {
    const std::size_t end = std::min(n, begin + kBlock);
    if (!any_of(uncertain + begin, end - begin)) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (uncertain[i] == 0) continue;
      const bool exact = (uncertain[i] & kOrderUncertain) == 0 && maps.invalid[i] == 0;
      uncertain[i] = exact && pixel_wrong_order_probability(maps, i) <= max_wrong_order_ ? 0 : 1;
    }
  }
}

double HierarchicalUnwrapper::pixel_wrong_order_probability(const TilePhases& maps,
                                                            std::size_t i) const {
  double chance = 0.0;
  double variance = 0.0;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const LevelLanes level = lanes_of(levels_[k], maps);
    double own = 1.0 / static_cast<double>(level.precision[i]);
    double wrapped = level.phase[i];
    if (level.is_beat()) {
      own += 1.0 / static_cast<double>(level.subtracted_precision[i]);
      wrapped -= static_cast<double>(level.subtracted[i]);
    }
    if (k == 0) {
      const double margin = kPi - std::abs(wrap_rad(wrapped - center_rad_));
      chance = std::erfc(margin / std::sqrt(2.0 * own));
    } else {
      const double ratio = levels_[k].per_unit / levels_[k - 1].per_unit;
      chance += wrong_order_probability(std::sqrt(ratio * ratio * variance + own));
    }
    variance = own;
  }
  return chance;
}

}  // namespace frangia
