#include "frangia/phase/climb_ladder.h"

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

/// Phase of a rung, and its variance as a fraction: a division takes longer than all the rest.
struct Lanes {
  alignas(64) Lane phase;
  alignas(64) Lane over;
  alignas(64) Lane under;
};

FRANGIA_VECTORISED void take_map(RungLanes rung, std::size_t n, Lanes& __restrict out) {
  for (std::size_t i = 0; i < n; ++i) {
    out.phase[i] = rung.phase[i];
    out.over[i] = 1.0F;
    out.under[i] = rung.precision[i];
  }
}

FRANGIA_VECTORISED void take_beat(RungLanes rung, std::size_t n, Lanes& __restrict out) {
  for (std::size_t i = 0; i < n; ++i) {
    out.phase[i] = rung.phase[i] - rung.less[i];
    out.over[i] = rung.precision[i] + rung.less_precision[i];
    out.under[i] = rung.precision[i] * rung.less_precision[i];
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

/// The first step: nothing to lift, but noise slips over at the ends of the single fringe.
FRANGIA_VECTORISED void start(Lanes& __restrict at,
                              std::size_t n,
                              float centre,
                              Margins margins,
                              std::int32_t* __restrict state) {
  for (std::size_t i = 0; i < n; ++i) {
    const float away = at.phase[i] - centre;
    const float from_centre = away - kTurnRad * nearest(away * kPerTurn);
    const float left = 3.14159265F - std::fabs(from_centre);
    const float margin = (left > 0.0F ? left * left : 0.0F) * at.under[i];
    at.phase[i] = centre + from_centre;
    state[i] = (margin >= margins.safe * at.over[i] ? 0 : kUnsafe) |
               (margin < margins.least * at.over[i] ? kDoubtful : 0);
  }
}

/// The next finer step, lifted to where the coarse one expects it; `fine` takes its place.
FRANGIA_VECTORISED void lift(const Lanes& __restrict coarse,
                             std::size_t n,
                             float ratio,
                             Margins margins,
                             Lanes& __restrict fine,
                             std::int32_t* __restrict state) {
  constexpr float kMargin = 9.86960440F;  // pi squared
  for (std::size_t i = 0; i < n; ++i) {
    const float over =
        ratio * ratio * coarse.over[i] * fine.under[i] + fine.over[i] * coarse.under[i];
    const float margin = kMargin * (coarse.under[i] * fine.under[i]);
    const float apart = ratio * coarse.phase[i] - fine.phase[i];
    state[i] |= (margin >= margins.safe * over ? 0 : kUnsafe) |
                (margin < margins.least * over ? kDoubtful : 0);
    fine.phase[i] += kTurnRad * nearest(apart * kPerTurn);
  }
}

/// One map's share in the slope of phase over frequency: how far it lies from the finest one's.
FRANGIA_VECTORISED void weigh(const float* __restrict phase,
                              const float* __restrict precision,
                              const float* __restrict at,
                              std::size_t n,
                              float ratio,
                              float* __restrict sum,
                              float* __restrict weights) {
  for (std::size_t i = 0; i < n; ++i) {
    const float away = phase[i] - ratio * at[i];
    const float apart = away - kTurnRad * nearest(away * kPerTurn);
    const float weight = ratio * precision[i];
    sum[i] += weight * apart;
    weights[i] += weight * ratio;
  }
}

FRANGIA_VECTORISED void finish(const float* __restrict at,
                               const float* __restrict sum,
                               const float* __restrict weights,
                               std::size_t n,
                               float* __restrict absolute,
                               float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    absolute[i] = at[i] + sum[i] / weights[i];
    sigma[i] = 1.0F / std::sqrt(weights[i]);
  }
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

void take(const LadderStep& step, const LadderClimb::Input& maps, std::size_t n, Lanes& out) {
  (step.less < 0 ? take_map : take_beat)(lanes_of(step, maps), n, out);
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
  std::array<Lanes, 2> lanes;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
  const Margins margins{static_cast<float>(safe_sigmas_ * safe_sigmas_),
                        static_cast<float>(least_sigmas_ * least_sigmas_)};
  take(steps_.front(), maps, n, lanes[0]);
  start(lanes[0], n, static_cast<float>(centre_rad_), margins, doubtful);
  for (std::size_t k = 1; k < steps_.size(); ++k) {
    Lanes& fine = lanes[k % 2];
    take(steps_[k], maps, n, fine);
    const double ratio = steps_[k].per_unit / steps_[k - 1].per_unit;
    lift(lanes[(k - 1) % 2], n, static_cast<float>(ratio), margins, fine, doubtful);
  }
  const Lane& at = lanes[(steps_.size() - 1) % 2].phase;
  alignas(64) Lane sum{};
  alignas(64) Lane weights{};
  for (std::size_t m = 0; m < ratios_.size(); ++m) {
    weigh(maps.phase_rad[m],
          maps.precision[m],
          at.data(),
          n,
          static_cast<float>(ratios_[m]),
          sum.data(),
          weights.data());
  }
  finish(at.data(), sum.data(), weights.data(), n, absolute_rad, sigma_rad);
  // What is not safe by a margin is looked at again, exactly.
  for (std::size_t i = 0; i < n; ++i) {
    if (doubtful[i] == 0) continue;
    const bool exact = (doubtful[i] & kDoubtful) == 0 && maps.lost[i] == 0;
    doubtful[i] = exact && wrong_chance(maps, i) <= max_wrong_order_ ? 0 : 1;
  }
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
