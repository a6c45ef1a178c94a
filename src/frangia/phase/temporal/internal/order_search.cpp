#include "frangia/phase/temporal/internal/order_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/pattern/order_confusion.h"
#include "frangia/phase/internal/frequency_slope.h"
#include "frangia/phase/internal/lane_math.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

/// Sums over the maps of the weighted residuals of one order.
struct Residuals {
  alignas(64) Lane square;  ///< of the residuals
  alignas(64) Lane along;   ///< of the residuals times the frequency: the common shift
};

/// The most likely order so far and the squared residuals of it and of the second.
struct Best {
  alignas(64) Lane absolute;
  alignas(64) Lane least;
  alignas(64) Lane second;
};

/// The finest map's phase in one order. Outside the field the residual grows with the distance.
FRANGIA_VECTORIZED void start_order(const float* __restrict wrapped,
                                    const float* __restrict precision,
                                    std::size_t n,
                                    float turns,
                                    float min_rad,
                                    float max_rad,
                                    float* __restrict absolute,
                                    Residuals& __restrict out) {
  for (std::size_t i = 0; i < n; ++i) {
    const float at = wrapped[i] + turns;
    const float below = min_rad - at;
    const float above = at - max_rad;
    const float outside = (below > 0.0F ? below : 0.0F) + (above > 0.0F ? above : 0.0F);
    absolute[i] = at;
    out.square[i] = precision[i] * outside * outside;
    out.along[i] = 0.0F;
  }
}

FRANGIA_VECTORIZED void add_map(const float* __restrict wrapped,
                                const float* __restrict precision,
                                float ratio,
                                std::size_t n,
                                const float* __restrict absolute,
                                Residuals& __restrict out) {
  for (std::size_t i = 0; i < n; ++i) {
    const float away = wrapped[i] - ratio * absolute[i];
    const float residual = wrap_lane(away);
    const float weighted = precision[i] * residual;
    out.square[i] += weighted * residual;
    out.along[i] += weighted * ratio;
  }
}

FRANGIA_VECTORIZED void add_slope_weight(const float* __restrict precision,
                                         float ratio,
                                         std::size_t n,
                                         float* __restrict weights) {
  for (std::size_t i = 0; i < n; ++i)
    weights[i] += ratio * ratio * precision[i];
}

FRANGIA_VECTORIZED void keep_best(const Residuals& __restrict of,
                                  const float* __restrict slope_weights,
                                  const float* __restrict absolute,
                                  std::size_t n,
                                  Best& __restrict best) {
  for (std::size_t i = 0; i < n; ++i) {
    const float found = of.square[i] - of.along[i] * of.along[i] / slope_weights[i];
    const float loser = found < best.least[i] ? best.least[i] : found;
    best.absolute[i] = found < best.least[i] ? absolute[i] : best.absolute[i];
    best.least[i] = found < best.least[i] ? found : best.least[i];
    best.second[i] = loser < best.second[i] ? loser : best.second[i];
  }
}

/// Marks the pixels whose two most likely orders differ too little.
FRANGIA_VECTORIZED void mark_uncertain(const Best& __restrict best,
                                       float min_difference,
                                       std::size_t n,
                                       std::int32_t* __restrict uncertain) {
  for (std::size_t i = 0; i < n; ++i)
    uncertain[i] = best.second[i] - best.least[i] >= min_difference ? 0 : 1;
}

}  // namespace

OrderSearch::OrderSearch(std::span<const Pattern> coarse_to_fine,
                         const Projector& projector,
                         double max_wrong_order) {
  require(!coarse_to_fine.empty(), "unwrap_sequence: no phase given");
  const PhaseRange field = phase_range(coarse_to_fine.back(), projector);
  const double top = coarse_to_fine.back().fringes_per_unit();
  std::vector<double> fringes;
  for (const Pattern& pattern : coarse_to_fine) {
    const double ratio = pattern.fringes_per_unit() / top;
    require(std::isfinite(ratio) && ratio > 0.0 && ratio <= 1.0,
            "unwrap_sequence: the phases must go from coarse to fine");
    ratios_.push_back(ratio);
    fringes.push_back(ratio * field.width_rad() / kTwoPi);
  }
  require(determines_order(fringes),
          "the fringe patterns do not determine an absolute phase: no combination of them is "
          "unique over the field");
  min_rad_ = field.min_rad;
  max_rad_ = field.max_rad;
  // Odds of the second order against the first are exp(-difference / 2).
  min_difference_ = static_cast<float>(-2.0 * std::log(std::min(1.0, max_wrong_order)));
}

void OrderSearch::unwrap(const TilePhases& maps,
                         std::size_t n,
                         float* absolute_rad,
                         float* sigma_rad,
                         std::int32_t* uncertain) const {
  Residuals residuals;        // NOLINT(cppcoreguidelines-pro-type-member-init): per order
  Best best;                  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
  alignas(64) Lane absolute;  // NOLINT(cppcoreguidelines-pro-type-member-init): per order
  alignas(64) Lane slope_weights{};
  best.least.fill(std::numeric_limits<float>::max());
  best.second.fill(std::numeric_limits<float>::max());
  best.absolute.fill(0.0F);
  const std::size_t finest = ratios_.size() - 1;
  for (std::size_t m = 0; m <= finest; ++m)
    add_slope_weight(maps.precision[m], static_cast<float>(ratios_[m]), n, slope_weights.data());
  const double first = std::floor((min_rad_ - kPi) / kTwoPi);
  const double last = std::ceil((max_rad_ + kPi) / kTwoPi);
  for (double order = first; order <= last; order += 1.0) {
    start_order(maps.phase_rad[finest],
                maps.precision[finest],
                n,
                static_cast<float>(kTwoPi * order),
                static_cast<float>(min_rad_),
                static_cast<float>(max_rad_),
                absolute.data(),
                residuals);
    for (std::size_t m = 0; m < finest; ++m) {
      add_map(maps.phase_rad[m],
              maps.precision[m],
              static_cast<float>(ratios_[m]),
              n,
              absolute.data(),
              residuals);
    }
    keep_best(residuals, slope_weights.data(), absolute.data(), n, best);
  }
  mark_uncertain(best, min_difference_, n, uncertain);
  fit_frequency_slope(maps, ratios_, best.absolute.data(), n, absolute_rad, sigma_rad);
}

}  // namespace frangia
