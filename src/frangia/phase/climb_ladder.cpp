#include "frangia/phase/climb_ladder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/vectorised.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/wrap_tile.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

constexpr float kTurnRad = 6.28318531F;
constexpr float kPerTurn = 0.159154943F;

/// To the nearest whole number, of numbers below four million; vectorises without an instruction
/// for it.
[[gnu::always_inline]] inline float nearest(float value) {
  constexpr float kShift = 12582912.0F;  // 1.5 * 2^23
  return (value + kShift) - kShift;
}

/// A map, or a beat of two.
struct RungLanes {
  const float* phase;
  const float* less;
  const float* precision;
  const float* less_precision;
};

/// Wrapped phase of a rung, and its variance as a fraction: a division takes longer than all the
/// rest.
struct Rung {
  float phase;
  float over;
  float under;
};

template <bool IsBeat>
[[gnu::always_inline]] inline Rung rung_at(const RungLanes& rung, std::size_t i) {
  if constexpr (IsBeat) {
    return {rung.phase[i] - rung.less[i],
            rung.precision[i] + rung.less_precision[i],
            rung.precision[i] * rung.less_precision[i]};
  } else {
    return {rung.phase[i], 1.0F, rung.precision[i]};
  }
}

// What is known of a pixel's order: a set of these.
constexpr std::int32_t kUnsafe = 1;    ///< to be looked at exactly
constexpr std::int32_t kDoubtful = 2;  ///< one step alone is over the limit

/// Squares of the sigmas that half a fringe must be away.
struct Margins {
  float safe;   ///< so that all steps together are under the limit
  float least;  ///< so that one step alone is
};

[[gnu::always_inline]] inline std::int32_t judge(float margin, float over, Margins margins) {
  return (margin >= margins.safe * over ? 0 : kUnsafe) |
         (margin < margins.least * over ? kDoubtful : 0);
}

/// The first step: nothing to lift, but noise slips over at the ends of the single fringe.
template <bool IsBeat>
FRANGIA_VECTORISED void start(const RungLanes& rung,
                              std::size_t n,
                              float centre,
                              Margins margins,
                              float* __restrict absolute,
                              std::int32_t* __restrict state) {
  for (std::size_t i = 0; i < n; ++i) {
    const Rung at = rung_at<IsBeat>(rung, i);
    const float away = at.phase - centre;
    const float from_centre = away - kTurnRad * nearest(away * kPerTurn);
    const float left = 3.14159265F - std::fabs(from_centre);
    const float margin = (left > 0.0F ? left * left : 0.0F) * at.under;
    absolute[i] = centre + from_centre;
    state[i] = judge(margin, at.over, margins);
  }
}

/// A step and the next finer one.
struct Lift {
  RungLanes coarse;
  RungLanes fine;
  float ratio;  ///< of their fringes
  Margins margins;
};

/// The next finer step, lifted to where the coarse one expects it.
template <bool CoarseIsBeat, bool FineIsBeat>
FRANGIA_VECTORISED void lift(const Lift& step,
                             std::size_t n,
                             const float* __restrict coarse,
                             float* __restrict fine,
                             std::int32_t* __restrict state) {
  constexpr float kMargin = 9.86960440F;  // pi squared
  const Lift by = step;
  for (std::size_t i = 0; i < n; ++i) {
    const Rung from = rung_at<CoarseIsBeat>(by.coarse, i);
    const Rung to = rung_at<FineIsBeat>(by.fine, i);
    const float over = by.ratio * by.ratio * from.over * to.under + to.over * from.under;
    const float margin = kMargin * (from.under * to.under);
    const float apart = by.ratio * coarse[i] - to.phase;
    state[i] |= judge(margin, over, by.margins);
    fine[i] = to.phase + kTurnRad * nearest(apart * kPerTurn);
  }
}

/// A map's part in the slope of phase over frequency.
struct Part {
  const float* phase;
  const float* precision;
  float ratio;  ///< of its fringes to the finest one's
};

/// Two maps' share in the slope of phase over frequency: how far they lie from the finest one's.
/// The first two set the sums.
template <bool IsFirst>
FRANGIA_VECTORISED void weigh(const Part& first,
                              const Part& second,
                              const float* __restrict at,
                              std::size_t n,
                              float* __restrict sum,
                              float* __restrict weights) {
  const Part a = first;
  const Part b = second;
  for (std::size_t i = 0; i < n; ++i) {
    const float away_a = a.phase[i] - a.ratio * at[i];
    const float away_b = b.phase[i] - b.ratio * at[i];
    const float weight_a = a.ratio * a.precision[i];
    const float weight_b = b.ratio * b.precision[i];
    const float found = weight_a * (away_a - kTurnRad * nearest(away_a * kPerTurn)) +
                        weight_b * (away_b - kTurnRad * nearest(away_b * kPerTurn));
    const float weight = weight_a * a.ratio + weight_b * b.ratio;
    sum[i] = IsFirst ? found : sum[i] + found;
    weights[i] = IsFirst ? weight : weights[i] + weight;
  }
}

FRANGIA_VECTORISED void finish(const float* __restrict at,
                               const float* __restrict sum,
                               const float* __restrict weights,
                               std::size_t n,
                               float* __restrict absolute,
                               float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    const float variance = 1.0F / weights[i];
    absolute[i] = at[i] + sum[i] * variance;
    sigma[i] = std::sqrt(variance);
  }
}

/// Whether any of them is not 0.
FRANGIA_VECTORISED bool any_of(const std::int32_t* state, std::size_t n) {
  std::int32_t all = 0;
  for (std::size_t i = 0; i < n; ++i)
    all |= state[i];
  return all != 0;
}

/// The lanes of a step; a map that stands alone is less nothing.
RungLanes lanes_of(const LadderStep& step, const LadderClimb::Input& maps) {
  if (step.less < 0) return {maps.phase_rad[step.map], nullptr, maps.precision[step.map], nullptr};
  const auto less = static_cast<std::size_t>(step.less);
  return {maps.phase_rad[step.map],
          maps.phase_rad[less],
          maps.precision[step.map],
          maps.precision[less]};
}

using LiftLanes = void (*)(const Lift&, std::size_t, const float*, float*, std::int32_t*);

LiftLanes lift_between(const LadderStep& coarse, const LadderStep& fine) {
  if (coarse.less < 0) return fine.less < 0 ? LiftLanes{lift<false, false>} : lift<false, true>;
  return fine.less < 0 ? LiftLanes{lift<true, false>} : lift<true, true>;
}

}  // namespace

LadderClimb::LadderClimb(std::span<const Pattern> coarse_to_fine,
                         const Projector& projector,
                         double max_wrong_order)
    : max_wrong_order_(max_wrong_order), safe_sigmas_(0.0), least_sigmas_(0.0), centre_rad_(0.0) {
  require(!coarse_to_fine.empty(), "unwrap_sequence: no phase given");
  const double top = coarse_to_fine.back().fringes_per_unit();
  for (const Pattern& pattern : coarse_to_fine) {
    require(std::isfinite(pattern.fringes_per_unit()) && pattern.fringes_per_unit() > 0.0 &&
                pattern.fringes_per_unit() >= coarse_to_fine.front().fringes_per_unit() &&
                pattern.fringes_per_unit() <= top,
            "unwrap_sequence: the phases must go from coarse to fine");
    ratios_.push_back(pattern.fringes_per_unit() / top);
  }
  steps_ = find_ladder(coarse_to_fine, projector);
  require(!steps_.empty(),
          "the fringe patterns tell no absolute phase together: none of them, and no beat of two, "
          "holds one fringe or less over the field");
  const auto count = static_cast<double>(steps_.size());
  safe_sigmas_ = kPi / sigma_of_chance(max_wrong_order / count);
  least_sigmas_ = kPi / sigma_of_chance(max_wrong_order);
  centre_rad_ =
      steps_.front().per_unit / top * phase_range(coarse_to_fine.back(), projector).centre_rad();
}

void LadderClimb::climb(const Input& maps,
                        std::size_t n,
                        float* absolute_rad,
                        float* sigma_rad,
                        std::int32_t* doubtful) const {
  alignas(64) std::array<Lane, 2> lanes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const Margins margins{static_cast<float>(safe_sigmas_ * safe_sigmas_),
                        static_cast<float>(least_sigmas_ * least_sigmas_)};
  RungLanes coarse = lanes_of(steps_.front(), maps);
  (steps_.front().less < 0 ? start<false> : start<true>)(coarse,
                                                         n,
                                                         static_cast<float>(centre_rad_),
                                                         margins,
                                                         lanes[0].data(),
                                                         doubtful);
  for (std::size_t k = 1; k < steps_.size(); ++k) {
    const RungLanes fine = lanes_of(steps_[k], maps);
    const double ratio = steps_[k].per_unit / steps_[k - 1].per_unit;
    lift_between(steps_[k - 1], steps_[k])({coarse, fine, static_cast<float>(ratio), margins},
                                           n,
                                           lanes[(k - 1) % 2].data(),
                                           lanes[k % 2].data(),
                                           doubtful);
    coarse = fine;
  }
  fit_slope(maps, lanes[(steps_.size() - 1) % 2].data(), n, absolute_rad, sigma_rad);
  // What is not safe by a margin is looked at again, exactly.
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < n; begin += kBlock) {
    const std::size_t end = std::min(n, begin + kBlock);
    if (!any_of(doubtful + begin, end - begin)) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (doubtful[i] == 0) continue;
      const bool exact = (doubtful[i] & kDoubtful) == 0 && maps.lost[i] == 0;
      doubtful[i] = exact && wrong_chance(maps, i) <= max_wrong_order_ ? 0 : 1;
    }
  }
}

void LadderClimb::fit_slope(const Input& maps,
                            const float* at,
                            std::size_t n,
                            float* absolute_rad,
                            float* sigma_rad) const {
  alignas(64) Lane sum;      // NOLINT(cppcoreguidelines-pro-type-member-init): set by the first two
  alignas(64) Lane weights;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t m = 0; m < ratios_.size(); m += 2) {
    // An odd last one goes with itself at no weight.
    const bool pair = m + 1 < ratios_.size();
    const std::size_t other = pair ? m + 1 : m;
    (m == 0 ? weigh<true>
            : weigh<false>)({maps.phase_rad[m], maps.precision[m], static_cast<float>(ratios_[m])},
                            {maps.phase_rad[other],
                             maps.precision[other],
                             pair ? static_cast<float>(ratios_[other]) : 0.0F},
                            at,
                            n,
                            sum.data(),
                            weights.data());
  }
  finish(at, sum.data(), weights.data(), n, absolute_rad, sigma_rad);
}

double LadderClimb::wrong_chance(const Input& maps, std::size_t i) const {
  double chance = 0.0;
  double variance = 0.0;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const RungLanes rung = lanes_of(steps_[k], maps);
    double own = 1.0 / static_cast<double>(rung.precision[i]);
    double wrapped = rung.phase[i];
    if (rung.less != nullptr) {
      own += 1.0 / static_cast<double>(rung.less_precision[i]);
      wrapped -= static_cast<double>(rung.less[i]);
    }
    if (k == 0) {
      const double margin = kPi - std::abs(wrap_rad(wrapped - centre_rad_));
      chance = std::erfc(margin / std::sqrt(2.0 * own));
    } else {
      const double ratio = steps_[k].per_unit / steps_[k - 1].per_unit;
      chance += wrong_order_chance(std::sqrt(ratio * ratio * variance + own));
    }
    variance = own;
  }
  return chance;
}

}  // namespace frangia
