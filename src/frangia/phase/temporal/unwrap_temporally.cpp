#include "frangia/phase/temporal/unwrap_temporally.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/internal/row_smoother.h"
#include "frangia/rig/rig.h"

namespace frangia {

namespace {

constexpr std::size_t kLevelChunk = 1 << 16;

/// The still wrapped phase of a level, in new memory.
AbsolutePhase start_from(const WrappedPhase& level) {
  return {level.pattern,
          level.phase_rad,
          level.sigma_rad,
          level.status,
          level.systematic_rad,
          level.differing_share};
}

/// The still wrapped phase of a level, in the level's memory.
AbsolutePhase start_from(WrappedPhase&& level) {
  return {std::move(level.pattern),
          std::move(level.phase_rad),
          std::move(level.sigma_rad),
          std::move(level.status),
          std::move(level.systematic_rad),
          level.differing_share};
}

/// Unwraps the coarsest level. Near the ends of the single fringe, noise may wrap the phase to the
/// other end; such pixels are uncertain.
void unwrap_single_fringe(const Projector& projector, double min_sigmas, AbsolutePhase& level) {
  const double center = phase_range(level.pattern, projector).center_rad();
  parallel_chunks(
      level.status.pixels().size(), kLevelChunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (level.status.pixels()[i] != PixelStatus::Measured) continue;
          float& phase = level.phase_rad.pixels()[i];
          float& sigma = level.sigma_rad.pixels()[i];
          const double from_center = wrap_rad(phase - center);
          phase = static_cast<float>(center + from_center);
          if (kPi - std::abs(from_center) > min_sigmas * sigma) continue;
          level.status.pixels()[i] = PixelStatus::UncertainOrder;
          phase = sigma = kMissing;
          if (!level.systematic_rad.empty()) level.systematic_rad.pixels()[i] = kMissing;
        }
      });
}

/// A row of the coarse phase.
struct CoarseRow {
  const float* phase_rad;
  const float* sigma_rad;
  const PixelStatus* status;
  double fringes_per_unit;
};

void unwrap_row(const CoarseRow& coarse, double max_sigma, int y, AbsolutePhase& fine) {
  const double ratio = fine.pattern.fringes_per_unit() / coarse.fringes_per_unit;
  for (int x = 0; x < fine.phase_rad.width(); ++x) {
    if (fine.status(x, y) != PixelStatus::Measured) continue;
    const double expected = ratio * coarse.phase_rad[x];
    const double wrapped = fine.phase_rad(x, y);
    const double sigma = std::hypot(ratio * coarse.sigma_rad[x], fine.sigma_rad(x, y));
    if (coarse.status[x] == PixelStatus::Measured && sigma <= max_sigma) {
      fine.phase_rad(x, y) =
          static_cast<float>(wrapped + kTwoPi * std::round((expected - wrapped) / kTwoPi));
      continue;
    }
    const bool invalid_before = coarse.status[x] != PixelStatus::Measured;
    fine.status(x, y) = invalid_before ? coarse.status[x] : PixelStatus::UncertainOrder;
    fine.phase_rad(x, y) = kMissing;
    fine.sigma_rad(x, y) = kMissing;
    if (!fine.systematic_rad.empty()) fine.systematic_rad(x, y) = kMissing;
  }
}

/// Unwraps a level by the smoothed coarser one, row by row, so that the smoothed rows stay in the
/// cache.
void unwrap_level(const AbsolutePhase& coarse,
                  int smooth_radius_px,
                  double max_sigma,
                  AbsolutePhase& fine) {
  constexpr std::size_t kRows = 16;
  require(fine.pattern.fringes_per_unit() > coarse.pattern.fringes_per_unit(),
          "unwrap_finer_levels: the phases must go from coarse to fine");
  require(same_size(fine.phase_rad, coarse.phase_rad),
          "unwrap_finer_levels: the phases differ in size");
  const auto height = static_cast<std::size_t>(fine.status.height());
  const double fringes_per_unit = coarse.pattern.fringes_per_unit();
  parallel_chunks(height, kRows, [&](std::size_t begin, std::size_t end) {
    RowSmoother smoother(coarse, smooth_radius_px);
    for (std::size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      const PixelStatus* status = &fine.status(0, y);
      const PixelStatus* status_end = status + fine.status.width();
      if (std::find(status, status_end, PixelStatus::Measured) == status_end) continue;
      smoother.smooth(y);
      unwrap_row(
          {smoother.phase_rad(), smoother.sigma_rad(), &coarse.status(0, y), fringes_per_unit},
          max_sigma,
          y,
          fine);
    }
  });
}

/// Unwraps finer levels. Moves out of `finer` unless its elements are constant.
template <typename Level>
AbsolutePhase unwrap_levels(AbsolutePhase absolute,
                            std::span<Level> finer,
                            const TemporalUnwrapOptions& options) {
  const double max_sigma = sigma_for_wrong_order_probability(options.max_wrong_order);
  for (Level& level : finer) {
    AbsolutePhase unwrapped = start_from(std::move(level));
    unwrap_level(absolute, options.smooth_radius_px, max_sigma, unwrapped);
    absolute = std::move(unwrapped);
  }
  return absolute;
}

template <typename Level>
AbsolutePhase unwrap_all_levels(std::span<Level> coarse_to_fine,
                                const Projector& projector,
                                const TemporalUnwrapOptions& options) {
  require(!coarse_to_fine.empty(), "unwrap_temporally: no phase given");
  require(is_absolute(coarse_to_fine.front().pattern, projector),
          "unwrap_temporally: the first level must have at most one fringe over the field");
  const double sigmas = kPi / sigma_for_wrong_order_probability(options.max_wrong_order);
  AbsolutePhase coarsest = start_from(std::move(coarse_to_fine.front()));
  unwrap_single_fringe(projector, sigmas, coarsest);
  return unwrap_levels(std::move(coarsest), coarse_to_fine.subspan(1), options);
}

}  // namespace

AbsolutePhase unwrap_finer_levels(AbsolutePhase absolute,
                                  std::span<const WrappedPhase> finer,
                                  const TemporalUnwrapOptions& options) {
  return unwrap_levels(std::move(absolute), finer, options);
}

AbsolutePhase unwrap_temporally(std::span<const WrappedPhase> coarse_to_fine,
                                const Projector& projector,
                                const TemporalUnwrapOptions& options) {
  return unwrap_all_levels(coarse_to_fine, projector, options);
}

AbsolutePhase unwrap_temporally_in_place(std::vector<WrappedPhase>&& coarse_to_fine,
                                         const Projector& projector,
                                         const TemporalUnwrapOptions& options) {
  return unwrap_all_levels(std::span(coarse_to_fine), projector, options);
}

namespace {

/// Planned probability of a wrong order per level. The actual probability is computed for each
/// pixel.
constexpr double kPlannedProbability = 1e-6;

/// Rounding tolerance for one fringe over the field.
constexpr double kOneFringe = 1.0 + 1e-6;

/// Maps and beats, coarse to fine.
std::vector<UnwrapLevel> candidate_levels(std::span<const Pattern> patterns) {
  std::vector<UnwrapLevel> candidates;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    candidates.push_back({i, -1, patterns[i].fringes_per_unit()});
    for (std::size_t j = 0; j < patterns.size(); ++j) {
      const double beat = patterns[i].fringes_per_unit() - patterns[j].fringes_per_unit();
      if (beat > 1e-9 * patterns[i].fringes_per_unit())
        candidates.push_back({i, static_cast<int>(j), beat});
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(), [](const UnwrapLevel& a, const UnwrapLevel& b) {
        return a.per_unit < b.per_unit;
      });
  return candidates;
}

double level_sigma(const UnwrapLevel& candidate, double sigma_rad) {
  return candidate.subtracted < 0 ? sigma_rad : sigma_rad * std::numbers::sqrt2;
}

/// Noise of the comparison of a scaled coarse level with the next finer one.
double transition_sigma(const UnwrapLevel& coarse, const UnwrapLevel& fine, double sigma_rad) {
  const double ratio = fine.per_unit / coarse.per_unit;
  return std::hypot(ratio * level_sigma(coarse, sigma_rad), level_sigma(fine, sigma_rad));
}

}  // namespace

std::vector<UnwrapLevel> find_unwrap_levels(std::span<const Pattern> patterns,
                                            const Projector& projector,
                                            double sigma_rad) {
  if (patterns.empty()) return {};
  const auto candidates = candidate_levels(patterns);
  const PhaseRange field = phase_range(patterns.back(), projector);
  const double units = field.width_rad() / kTwoPi / patterns.back().fringes_per_unit();
  std::vector<UnwrapLevel> levels;
  for (const UnwrapLevel& candidate : candidates) {  // the finest level of at most one fringe
    if (candidate.per_unit * units <= kOneFringe) levels.assign(1, candidate);
  }
  if (levels.empty()) return {};
  const double top = patterns.back().fringes_per_unit();
  while (levels.back().per_unit < top || levels.back().subtracted >= 0) {
    const UnwrapLevel& here = levels.back();
    const UnwrapLevel* next = nullptr;
    for (const UnwrapLevel& candidate : candidates) {
      if (candidate.per_unit < here.per_unit) continue;
      if (candidate.per_unit == here.per_unit && (candidate.subtracted >= 0 || here.subtracted < 0))
        continue;
      const double sigma = transition_sigma(here, candidate, sigma_rad);
      // The finest safe level, or the next finer one if none is safe.
      if (next == nullptr || wrong_order_probability(sigma) < kPlannedProbability)
        next = &candidate;
    }
    if (next == nullptr) return {};
    levels.push_back(*next);
  }
  return levels;
}

bool is_safe(std::span<const UnwrapLevel> levels, double sigma_rad, double max_wrong_order) {
  for (std::size_t k = 1; k < levels.size(); ++k) {
    if (wrong_order_probability(transition_sigma(levels[k - 1], levels[k], sigma_rad)) >
        max_wrong_order)
      return false;
  }
  return !levels.empty();
}

}  // namespace frangia
