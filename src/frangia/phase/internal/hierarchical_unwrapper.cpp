#include "frangia/phase/internal/hierarchical_unwrapper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

constexpr float kTwoPiRad = 6.28318531F;
constexpr float kPerTwoPi = 0.159154943F;

/// Rounds numbers below four million to the nearest integer; vectorizes without a rounding
/// instruction.
[[gnu::always_inline]] inline float nearest(float value) {
  constexpr float kShift = 12582912.0F;  // 1.5 * 2^23
  return (value + kShift) - kShift;
}

/// The data of a level: a map or the beat of two maps.
struct LevelLanes {
  const float* phase;
  const float* subtracted;
  const float* precision;
  const float* subtracted_precision;
};

/// Wrapped phase of a level and its variance as a fraction, because a division takes longer than
/// the rest.
struct LevelPhase {
  float phase;
  float variance_numerator;
  float variance_denominator;
};

template <bool IsBeat>
[[gnu::always_inline]] inline LevelPhase level_phase_at(const LevelLanes& level, std::size_t i) {
  if constexpr (IsBeat) {
    return {level.phase[i] -
                level.subtracted[i],  // NOLINT(clang-analyzer-core.NullDereference): a beat's
            level.precision[i] + level.subtracted_precision[i],
            level.precision[i] * level.subtracted_precision[i]};
  } else {
    return {level.phase[i], 1.0F, level.precision[i]};
  }
}

// Bits of the state of a pixel's order.
constexpr std::int32_t kUnsafe = 1;     ///< needs the exact probability
constexpr std::int32_t kUncertain = 2;  ///< a single level exceeds the limit

/// Squared margins in sigmas, compared with half a fringe.
struct Margins {
  float safe;     ///< all levels together are within the limit
  float minimum;  ///< a single level is within the limit
};

[[gnu::always_inline]] inline std::int32_t classify_margin(float margin,
                                                           float variance_numerator,
                                                           Margins margins) {
  return (margin >= margins.safe * variance_numerator ? 0 : kUnsafe) |
         (margin < margins.minimum * variance_numerator ? kUncertain : 0);
}

/// The first level and its phase at the centre of the field.
struct FirstLevel {
  LevelLanes level;
  float center;
  Margins margins;
};

/// Unwraps the first level: no coarser level exists, but noise can wrap phases near the ends of the
/// single fringe.
template <bool IsBeat>
FRANGIA_VECTORIZED void unwrap_first_level(const FirstLevel& first,
                                           std::size_t n,
                                           float* __restrict absolute,
                                           std::int32_t* __restrict state) {
  const auto [level, center, margins] = first;
  for (std::size_t i = 0; i < n; ++i) {
    const LevelPhase at = level_phase_at<IsBeat>(level, i);
    const float away = at.phase - center;
    const float from_center = away - kTwoPiRad * nearest(away * kPerTwoPi);
    const float left = 3.14159265F - std::fabs(from_center);
    const float margin = (left > 0.0F ? left * left : 0.0F) * at.variance_denominator;
    absolute[i] = center + from_center;
    state[i] = classify_margin(margin, at.variance_numerator, margins);
  }
}

/// A level and the next finer one.
struct LevelPair {
  LevelLanes coarse;
  LevelLanes fine;
  float ratio;  ///< ratio of their frequencies
  Margins margins;
};

/// Unwraps the next finer level by the scaled coarse one.
template <bool CoarseIsBeat, bool FineIsBeat>
FRANGIA_VECTORIZED void unwrap_next_level(const LevelPair& step,
                                          std::size_t n,
                                          const float* __restrict coarse,
                                          float* __restrict fine,
                                          std::int32_t* __restrict state) {
  constexpr float kMargin = 9.86960440F;  // pi squared
  const LevelPair by = step;
  for (std::size_t i = 0; i < n; ++i) {
    const LevelPhase from = level_phase_at<CoarseIsBeat>(by.coarse, i);
    const LevelPhase to = level_phase_at<FineIsBeat>(by.fine, i);
    const float variance_numerator =
        by.ratio * by.ratio * from.variance_numerator * to.variance_denominator +
        to.variance_numerator * from.variance_denominator;
    const float margin = kMargin * (from.variance_denominator * to.variance_denominator);
    const float apart = by.ratio * coarse[i] - to.phase;
    state[i] |= classify_margin(margin, variance_numerator, by.margins);
    fine[i] = to.phase + kTwoPiRad * nearest(apart * kPerTwoPi);
  }
}

/// The contribution of a map to the slope of phase over frequency.
struct MapTerm {
  const float* phase;
  const float* precision;
  float ratio;  ///< frequency relative to the finest map
};

/// Sums of the least-squares slope of phase over frequency.
struct Slope {
  alignas(64) Lane sum;
  alignas(64) Lane weights;
};

/// Adds two maps to the sums, as deviations from the finest map's phase. The first two maps
/// initialize the sums.
template <bool IsFirst>
FRANGIA_VECTORIZED void add_to_slope(const MapTerm& first,
                                     const MapTerm& second,
                                     const float* __restrict at,
                                     std::size_t n,
                                     Slope& __restrict slope) {
  const MapTerm a = first;
  const MapTerm b = second;
  for (std::size_t i = 0; i < n; ++i) {
    const float away_a = a.phase[i] - a.ratio * at[i];
    const float away_b = b.phase[i] - b.ratio * at[i];
    const float weight_a = a.ratio * a.precision[i];
    const float weight_b = b.ratio * b.precision[i];
    const float found = weight_a * (away_a - kTwoPiRad * nearest(away_a * kPerTwoPi)) +
                        weight_b * (away_b - kTwoPiRad * nearest(away_b * kPerTwoPi));
    const float weight = weight_a * a.ratio + weight_b * b.ratio;
    slope.sum[i] = IsFirst ? found : slope.sum[i] + found;
    slope.weights[i] = IsFirst ? weight : slope.weights[i] + weight;
  }
}

FRANGIA_VECTORIZED void finish_slope(const float* __restrict at,
                                     const Slope& __restrict slope,
                                     std::size_t n,
                                     float* __restrict absolute,
                                     float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    const float variance = 1.0F / slope.weights[i];
    absolute[i] = at[i] + slope.sum[i] * variance;
    sigma[i] = std::sqrt(variance);
  }
}

/// Returns whether any element is nonzero.
FRANGIA_VECTORIZED bool any_of(const std::int32_t* state, std::size_t n) {
  std::int32_t all = 0;
  for (std::size_t i = 0; i < n; ++i)
    all |= state[i];
  return all != 0;
}

/// The data of a level; `subtracted` is null for a single map.
LevelLanes lanes_of(const UnwrapLevel& step, const HierarchicalUnwrapper::Input& maps) {
  if (step.subtracted < 0)
    return {maps.phase_rad[step.map], nullptr, maps.precision[step.map], nullptr};
  const auto subtracted = static_cast<std::size_t>(step.subtracted);
  return {maps.phase_rad[step.map],
          maps.phase_rad[subtracted],
          maps.precision[step.map],
          maps.precision[subtracted]};
}

using NextLevelFunction =
    void (*)(const LevelPair&, std::size_t, const float*, float*, std::int32_t*);

NextLevelFunction next_level_function(const UnwrapLevel& coarse, const UnwrapLevel& fine) {
  if (coarse.subtracted < 0)
    return fine.subtracted < 0 ? NextLevelFunction{unwrap_next_level<false, false>}
                               : unwrap_next_level<false, true>;
  return fine.subtracted < 0 ? NextLevelFunction{unwrap_next_level<true, false>}
                             : unwrap_next_level<true, true>;
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

void HierarchicalUnwrapper::unwrap(const Input& maps,
                                   std::size_t n,
                                   float* absolute_rad,
                                   float* sigma_rad,
                                   std::int32_t* uncertain) const {
  alignas(64) std::array<Lane, 2> lanes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const Margins margins{static_cast<float>(safe_sigmas_ * safe_sigmas_),
                        static_cast<float>(min_sigmas_ * min_sigmas_)};
  LevelLanes coarse = lanes_of(levels_.front(), maps);
  const FirstLevel first{coarse, static_cast<float>(center_rad_), margins};
  (levels_.front().subtracted < 0 ? unwrap_first_level<false>
                                  : unwrap_first_level<true>)(first, n, lanes[0].data(), uncertain);
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const LevelLanes fine = lanes_of(levels_[k], maps);
    const double ratio = levels_[k].per_unit / levels_[k - 1].per_unit;
    next_level_function(levels_[k - 1], levels_[k])(
        {coarse, fine, static_cast<float>(ratio), margins},
        n,
        lanes[(k - 1) % 2].data(),
        lanes[k % 2].data(),
        uncertain);
    coarse = fine;
  }
  fit_slope(maps, lanes[(levels_.size() - 1) % 2].data(), n, absolute_rad, sigma_rad);
  // Pixels that the margins do not classify as safe get the exact probability.
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < n; begin += kBlock) {
    const std::size_t end = std::min(n, begin + kBlock);
    if (!any_of(uncertain + begin, end - begin)) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (uncertain[i] == 0) continue;
      const bool exact = (uncertain[i] & kUncertain) == 0 && maps.invalid[i] == 0;
      uncertain[i] = exact && pixel_wrong_order_probability(maps, i) <= max_wrong_order_ ? 0 : 1;
    }
  }
}

void HierarchicalUnwrapper::fit_slope(const Input& maps,
                                      const float* at,
                                      std::size_t n,
                                      float* absolute_rad,
                                      float* sigma_rad) const {
  Slope slope;  // NOLINT(cppcoreguidelines-pro-type-member-init): initialized by the first two maps
  for (std::size_t m = 0; m < ratios_.size(); m += 2) {
    // The last map of an odd number is paired with itself at weight zero.
    const bool pair = m + 1 < ratios_.size();
    const std::size_t other = pair ? m + 1 : m;
    const MapTerm one{maps.phase_rad[m], maps.precision[m], static_cast<float>(ratios_[m])};
    const MapTerm two{maps.phase_rad[other],
                      maps.precision[other],
                      pair ? static_cast<float>(ratios_[other]) : 0.0F};
    (m == 0 ? add_to_slope<true> : add_to_slope<false>)(one, two, at, n, slope);
  }
  finish_slope(at, slope, n, absolute_rad, sigma_rad);
}

double HierarchicalUnwrapper::pixel_wrong_order_probability(const Input& maps,
                                                            std::size_t i) const {
  double chance = 0.0;
  double variance = 0.0;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const LevelLanes level = lanes_of(levels_[k], maps);
    double own = 1.0 / static_cast<double>(level.precision[i]);
    double wrapped = level.phase[i];
    if (level.subtracted != nullptr) {
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
