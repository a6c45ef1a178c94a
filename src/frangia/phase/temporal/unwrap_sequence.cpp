#include "frangia/phase/temporal/unwrap_sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/internal/fringe_frequency.h"
#include "frangia/phase/internal/hierarchical_unwrapper.h"
#include "frangia/phase/internal/unwrap_level_lanes.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/rig/projector.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

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

constexpr std::size_t kUnwrapChunk = 16 * kTilePixels;

FRANGIA_VECTORIZED void precision_of(const float* __restrict from,
                                     std::size_t n,
                                     float* __restrict into) {
  for (std::size_t i = 0; i < n; ++i)
    into[i] = 1.0F / (from[i] * from[i]);
}

/// Status of a pixel over all maps. Saturation takes precedence, because a shorter exposure avoids
/// it.
PixelStatus status_of(std::span<const WrappedPhase> maps, std::size_t i) {
  PixelStatus status = PixelStatus::Measured;
  for (const WrappedPhase& map : maps) {
    if (map.status.pixels()[i] == PixelStatus::Saturated) return PixelStatus::Saturated;
    if (status == PixelStatus::Measured) status = map.status.pixels()[i];
  }
  return status;
}

/// The least share of the maps that have a systematic part.
float least_differing_share(std::span<const WrappedPhase> maps) {
  float least = 1.0F;
  for (const WrappedPhase& map : maps)
    if (!map.systematic_rad.empty()) least = std::min(least, map.differing_share);
  return least;
}

/// The systematic uncertainty of the slope of phase over frequency: those of the maps, which are
/// taken as independent, with the weights of `fit_frequency_slope`. Empty if no map has one.
Image<float> slope_systematic(std::span<const WrappedPhase> maps,
                              const Image<PixelStatus>& status) {
  const bool known = std::any_of(maps.begin(), maps.end(), [](const WrappedPhase& map) {
    return !map.systematic_rad.empty();
  });
  if (!known) return {};
  Image<float> out(status.width(), status.height(), kMissing);
  const double top = maps.back().pattern.fringes_per_unit();
  parallel_rows(status.height(), [&](int y) {
    for (int x = 0; x < status.width(); ++x) {
      if (status(x, y) != PixelStatus::Measured) continue;
      double weights = 0.0;
      double square = 0.0;
      for (const WrappedPhase& map : maps) {
        const double ratio = map.pattern.fringes_per_unit() / top;
        const double sigma = map.sigma_rad(x, y);
        const double weight = ratio / (sigma * sigma);
        weights += weight * ratio;
        if (map.systematic_rad.empty()) continue;
        const double part = weight * static_cast<double>(map.systematic_rad(x, y));
        square += part * part;
      }
      out(x, y) = static_cast<float>(std::sqrt(square) / weights);
    }
  });
  return out;
}

/// Unwraps all pixels, tile by tile, by a HierarchicalUnwrapper or an OrderSearch.
template <class Unwrapper>
AbsolutePhase unwrap_all(std::span<const WrappedPhase> coarse_to_fine, const Unwrapper& unwrapper) {
  const int width = coarse_to_fine.back().phase_rad.width();
  const int height = coarse_to_fine.back().phase_rad.height();
  AbsolutePhase out{coarse_to_fine.back().pattern,
                    Image<float>(width, height, Uninitialized{}),
                    Image<float>(width, height, Uninitialized{}),
                    Image<PixelStatus>(width, height, Uninitialized{})};
  parallel_chunks(
      out.status.pixels().size(), kUnwrapChunk, [&](std::size_t begin, std::size_t end) {
        std::vector<Lane> precisions(coarse_to_fine.size());
        std::vector<const float*> phase(coarse_to_fine.size());
        std::vector<const float*> precision(coarse_to_fine.size());
        std::array<std::int32_t, kTilePixels> invalid{};
        std::array<std::int32_t, kTilePixels> uncertain{};
        for (std::size_t at = begin; at < end; at += kTilePixels) {
          const std::size_t n = std::min(kTilePixels, end - at);
          for (std::size_t m = 0; m < phase.size(); ++m) {
            precision_of(coarse_to_fine[m].sigma_rad.pixels().data() + at, n, precisions[m].data());
            precision[m] = precisions[m].data();
            phase[m] = coarse_to_fine[m].phase_rad.pixels().data() + at;
          }
          float* absolute = out.phase_rad.pixels().data() + at;
          float* sigma = out.sigma_rad.pixels().data() + at;
          for (std::size_t i = 0; i < n; ++i)
            invalid[i] = static_cast<std::int32_t>(status_of(coarse_to_fine, at + i));
          unwrapper.unwrap(
              {phase, precision, invalid.data()}, n, absolute, sigma, uncertain.data());
          for (std::size_t i = 0; i < n; ++i) {
            auto status = static_cast<PixelStatus>(invalid[i]);
            if (status == PixelStatus::Measured && uncertain[i] != 0)
              status = PixelStatus::UncertainOrder;
            out.status.pixels()[at + i] = status;
            if (status != PixelStatus::Measured) absolute[i] = sigma[i] = kMissing;
          }
        }
      });
  out.systematic_rad = slope_systematic(coarse_to_fine, out.status);
  out.differing_share = least_differing_share(coarse_to_fine);
  return out;
}

/// Fringe counts of the maps over the field.
std::vector<double> fringe_counts(std::span<const Pattern> patterns, const Projector& projector) {
  std::vector<double> fringes;
  for (const Pattern& pattern : patterns)
    fringes.push_back(phase_range(pattern, projector).width_rad() / kTwoPi);
  return fringes;
}

/// Whether comparing one level with the next loses nothing: every level is a map of its own, or the
/// beats leave a wide margin.
bool suits_hierarchy(std::span<const UnwrapLevel> levels) {
  constexpr double kSigma = 0.05;
  constexpr double kMaxWrongOrder = 1e-4;
  const bool beats = std::any_of(
      levels.begin(), levels.end(), [](const UnwrapLevel& level) { return level.subtracted >= 0; });
  return !beats || is_safe(levels, kSigma, kMaxWrongOrder);
}

}  // namespace

std::optional<SequenceMethod> find_sequence_method(std::span<const Pattern> coarse_to_fine,
                                                   const Projector& projector) {
  if (coarse_to_fine.empty()) return std::nullopt;
  const std::vector<UnwrapLevel> levels = find_unwrap_levels(coarse_to_fine, projector);
  if (!levels.empty() && suits_hierarchy(levels)) return SequenceMethod::Levels;
  if (determines_order(fringe_counts(coarse_to_fine, projector))) return SequenceMethod::Search;
  // Levels with a narrow margin still serve where the search has none at all.
  if (!levels.empty()) return SequenceMethod::Levels;
  return std::nullopt;
}

AbsolutePhase unwrap_sequence(std::span<const WrappedPhase> coarse_to_fine,
                              const Projector& projector,
                              SequenceMethod method,
                              const TemporalUnwrapOptions& options) {
  std::vector<Pattern> patterns;
  for (const WrappedPhase& map : coarse_to_fine) {
    patterns.push_back(map.pattern);
    require(same_size(map.phase_rad, coarse_to_fine.front().phase_rad),
            "unwrap_sequence: the phases differ in size");
  }
  if (method == SequenceMethod::Levels) {
    return unwrap_all(coarse_to_fine,
                      HierarchicalUnwrapper(patterns, projector, options.max_wrong_order));
  }
  return unwrap_all(coarse_to_fine, OrderSearch(patterns, projector, options.max_wrong_order));
}

}  // namespace frangia
