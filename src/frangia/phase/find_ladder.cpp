#include "frangia/phase/find_ladder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frangia/core/angles.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

/// A step of a ladder is planned for this chance; what each pixel really has is computed for it.
constexpr double kPlannedChance = 1e-6;

/// Fringes that the whole field may hold and still be one, by rounding.
constexpr double kOneFringe = 1.0 + 1e-6;

/// Maps and beats, coarse to fine.
std::vector<LadderStep> all_rungs(std::span<const Pattern> patterns) {
  std::vector<LadderStep> rungs;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    rungs.push_back({i, -1, patterns[i].fringes_per_unit()});
    for (std::size_t j = 0; j < patterns.size(); ++j) {
      const double beat = patterns[i].fringes_per_unit() - patterns[j].fringes_per_unit();
      if (beat > 1e-9 * patterns[i].fringes_per_unit())
        rungs.push_back({i, static_cast<int>(j), beat});
    }
  }
  std::stable_sort(rungs.begin(), rungs.end(), [](const LadderStep& a, const LadderStep& b) {
    return a.per_unit < b.per_unit;
  });
  return rungs;
}

double rung_sigma(const LadderStep& rung, double sigma_rad) {
  return rung.less < 0 ? sigma_rad : sigma_rad * std::numbers::sqrt2;
}

/// Noise of a step's comparison, coarse lifted to fine.
double step_sigma(const LadderStep& coarse, const LadderStep& fine, double sigma_rad) {
  const double ratio = fine.per_unit / coarse.per_unit;
  return std::hypot(ratio * rung_sigma(coarse, sigma_rad), rung_sigma(fine, sigma_rad));
}

}  // namespace

std::vector<LadderStep> find_ladder(std::span<const Pattern> patterns,
                                    const Projector& projector,
                                    double sigma_rad) {
  if (patterns.empty()) return {};
  const auto rungs = all_rungs(patterns);
  const PhaseRange field = phase_range(patterns.back(), projector);
  const double units = field.width_rad() / kTurn / patterns.back().fringes_per_unit();
  std::vector<LadderStep> ladder;
  for (const LadderStep& rung : rungs) {  // the finest that is still one fringe
    if (rung.per_unit * units <= kOneFringe) ladder.assign(1, rung);
  }
  if (ladder.empty()) return {};
  const double top = patterns.back().fringes_per_unit();
  while (ladder.back().per_unit < top || ladder.back().less >= 0) {
    const LadderStep& here = ladder.back();
    const LadderStep* next = nullptr;
    for (const LadderStep& rung : rungs) {
      if (rung.per_unit < here.per_unit) continue;
      if (rung.per_unit == here.per_unit && (rung.less >= 0 || here.less < 0)) continue;
      const double sigma = step_sigma(here, rung, sigma_rad);
      // The finest that is safe, or else the very next one.
      if (next == nullptr || wrong_order_chance(sigma) < kPlannedChance) next = &rung;
    }
    if (next == nullptr) return {};
    ladder.push_back(*next);
  }
  return ladder;
}

bool is_safe(std::span<const LadderStep> ladder, double sigma_rad, double max_wrong_order) {
  for (std::size_t k = 1; k < ladder.size(); ++k) {
    if (wrong_order_chance(step_sigma(ladder[k - 1], ladder[k], sigma_rad)) > max_wrong_order)
      return false;
  }
  return !ladder.empty();
}

}  // namespace frangia
