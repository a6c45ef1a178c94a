#include "frangia/phase/temporal/unwrap_levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frangia/core/angles.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/rig/rig.h"

namespace frangia {
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
