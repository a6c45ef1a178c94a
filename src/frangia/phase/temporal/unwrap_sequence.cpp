#include "frangia/phase/temporal/unwrap_sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/pattern/order_confusion.h"
#include "frangia/phase/internal/hierarchical_unwrapper.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/temporal/internal/order_search.h"
#include "frangia/phase/temporal/unwrap_levels.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

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
