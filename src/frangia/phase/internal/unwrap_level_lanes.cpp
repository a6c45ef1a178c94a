#include "frangia/phase/internal/unwrap_level_lanes.h"

#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

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

[[gnu::always_inline]] inline std::int32_t classify_margin(float margin,
                                                           float variance_numerator,
                                                           Margins margins) {
  return (margin >= margins.safe * variance_numerator ? 0 : kOrderUnsafe) |
         (margin < margins.minimum * variance_numerator ? kOrderUncertain : 0);
}

template <bool IsBeat>
FRANGIA_VECTORIZED void unwrap_first_lanes(const FirstLevel& first,
                                           std::size_t n,
                                           float* __restrict absolute,
                                           std::int32_t* __restrict state) {
  const auto [level, center, margins] = first;
  for (std::size_t i = 0; i < n; ++i) {
    const LevelPhase at = level_phase_at<IsBeat>(level, i);
    const float away = at.phase - center;
    const float from_center = wrap_lane(away);
    const float left = kPiF - std::fabs(from_center);
    const float margin = (left > 0.0F ? left * left : 0.0F) * at.variance_denominator;
    absolute[i] = center + from_center;
    state[i] = classify_margin(margin, at.variance_numerator, margins);
  }
}

template <bool CoarseIsBeat, bool FineIsBeat>
FRANGIA_VECTORIZED void unwrap_next_lanes(const LevelPair& step,
                                          std::size_t n,
                                          const float* __restrict coarse,
                                          float* __restrict fine,
                                          std::int32_t* __restrict state) {
  constexpr auto kMargin = static_cast<float>(kPi * kPi);
  constexpr auto kPerTwoPi = static_cast<float>(1.0 / kTwoPi);
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
    fine[i] = to.phase + kTwoPiF * round_lane(apart * kPerTwoPi);
  }
}

}  // namespace

void unwrap_first_level(const FirstLevel& first,
                        std::size_t n,
                        float* absolute,
                        std::int32_t* state) {
  (first.level.is_beat() ? unwrap_first_lanes<true>
                         : unwrap_first_lanes<false>)(first, n, absolute, state);
}

void unwrap_next_level(
    const LevelPair& pair, std::size_t n, const float* coarse, float* fine, std::int32_t* state) {
  if (pair.coarse.is_beat()) {
    (pair.fine.is_beat() ? unwrap_next_lanes<true, true>
                         : unwrap_next_lanes<true, false>)(pair, n, coarse, fine, state);
  } else {
    (pair.fine.is_beat() ? unwrap_next_lanes<false, true>
                         : unwrap_next_lanes<false, false>)(pair, n, coarse, fine, state);
  }
}

}  // namespace frangia
