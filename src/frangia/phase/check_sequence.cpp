#include "frangia/phase/check_sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/phase/internal/sequence_sample.h"
#include "frangia/phase/internal/sequence_trials.h"
#include "frangia/phase/unwrap_sequence.h"

namespace frangia {
namespace {

/// Systematic phase error, rad, that a sound map may have: harmonics of a display, errors of steps.
constexpr double kSystematic_rad = 0.05;

/// Largest expected misfit of a sound sequence, over chance, for which the check decides.
constexpr double kMaxExpected = 0.4;

/// Residual of the fringe fit over the modulation: frames of another order have 0.5 and more,
/// harmonics of 10 % leave 0.1.
constexpr double kMaxFitResidual = 0.3;
constexpr double kFittedResidual = 0.4;  ///< of a declaration that fits, over that of scan.toml

/// Share of the rows in which the ends of the field may meet with a declaration that fits.
constexpr double kUnsplit = 0.05;

struct RankedTrial {
  SequenceTrial trial;
  double misfit_rad = 0.0;
};

/// The period that the frames show, rounded as far as the misfit stays the same.
void add_shown_period(const SequenceSample& sample,
                      std::size_t map,
                      std::vector<SequenceTrial>& trials) {
  const double shown = sample.shown_frequency(map);
  if (shown == 0.0) return;
  constexpr double kSame = 1.1;  // misfit of the rounded value over that of the estimate
  const bool angular = sample.patterns()[map].fringes_per_degree > 0.0;
  SequenceTrial exact = period_trial(sample.patterns(), map, shown);
  const double misfit = sample.misfit(exact);
  const std::array<double, 3> units =
      angular ? std::array{1.0, 0.1, 0.01} : std::array{1.0, 0.5, 0.1};
  for (const double unit : units) {
    const double value = angular ? shown : 1.0 / shown;
    const double rounded = unit * std::round(value / unit);
    if (!(rounded > 0.0)) continue;
    SequenceTrial trial = period_trial(sample.patterns(), map, angular ? rounded : 1.0 / rounded);
    if (sample.misfit(trial) > kSame * misfit) continue;
    trials.push_back(std::move(trial));
    return;
  }
  trials.push_back(std::move(exact));
}

std::vector<SequenceTrial> all_trials(const SequenceSample& sample) {
  std::vector<SequenceTrial> trials;
  const auto append = [&](std::vector<SequenceTrial> more) {
    std::move(more.begin(), more.end(), std::back_inserter(trials));
  };
  for (std::size_t map = 0; map < sample.patterns().size(); ++map) {
    append(shift_trials(sample.patterns(), map));
    add_shown_period(sample, map, trials);
    append(period_trials(sample.patterns(), map));
  }
  append(joint_trials(sample.patterns()));
  return trials;
}

/// The start of one map that fits best, to a degree.
SequenceTrial free_start(const SequenceSample& sample, std::size_t map) {
  double best_deg = 0.0;
  double least = std::numeric_limits<double>::max();
  const auto look = [&](double from_deg, double to_deg, double step_deg) {
    for (double start = from_deg; start <= to_deg; start += step_deg) {
      const double found = sample.misfit(start_trial(sample.patterns(), map, rad_from_deg(start)));
      if (found >= least) continue;
      least = found;
      best_deg = start;
    }
  };
  look(10.0, 350.0, 10.0);
  look(best_deg - 8.0, best_deg + 8.0, 2.0);
  look(best_deg - 1.0, best_deg + 1.0, 1.0);
  return start_trial(sample.patterns(), map, rad_from_deg(best_deg));
}

/// Starts that are no multiples of a quarter turn: of all maps, or of the map whose start `found`
/// names, if they fit decisively better.
std::vector<SequenceTrial> free_starts(const SequenceSample& sample,
                                       const std::vector<RankedTrial>& found) {
  constexpr double kBetter = 0.8;  // misfit over that of the quarter turn
  std::vector<SequenceTrial> trials;
  if (found.empty()) {
    for (std::size_t map = 0; map < sample.patterns().size(); ++map)
      trials.push_back(free_start(sample, map));
    return trials;
  }
  for (const RankedTrial& one : found) {
    const bool start = one.trial.fault.kind == SequenceFaultKind::Start;
    if (!start || one.trial.changes.size() != 1) continue;
    SequenceTrial trial = free_start(sample, one.trial.changes.front().map);
    if (sample.misfit(trial) < kBetter * one.misfit_rad) trials.push_back(std::move(trial));
  }
  return trials;
}

/// Sorts trials by their misfit and keeps those that fit decisively better than scan.toml, and
/// than unrelated phases. Equal trials are kept once.
std::vector<RankedTrial> fitting(const SequenceSample& sample,
                                 std::vector<SequenceTrial> trials,
                                 double max_misfit_rad,
                                 const SequenceCheckOptions& options) {
  std::vector<RankedTrial> fitting;
  for (SequenceTrial& trial : trials) {
    const double misfit = sample.misfit(trial);
    if (misfit > max_misfit_rad || misfit > options.max_misfit * sample.chance(trial)) continue;
    const bool known = std::any_of(fitting.begin(), fitting.end(), [&](const RankedTrial& other) {
      return other.trial.fault.patterns == trial.fault.patterns &&
             other.trial.fault.keys == trial.fault.keys;
    });
    if (!known) fitting.push_back({std::move(trial), misfit});
  }
  std::stable_sort(fitting.begin(), fitting.end(), [](const auto& a, const auto& b) {
    return a.misfit_rad < b.misfit_rad;
  });
  return fitting;
}

/// Of trials that fit nearly as well as the best one, those that do not split the surface and whose
/// frames fit their shifts.
std::vector<RankedTrial> plausible(const SequenceSample& sample,
                                   std::vector<RankedTrial> fitting,
                                   double tie,
                                   bool absolute) {
  constexpr double kConsidered = 1.6;  // times the least misfit
  if (fitting.empty()) return fitting;
  const double limit = kConsidered * fitting.front().misfit_rad;
  std::erase_if(fitting, [&](const RankedTrial& one) { return one.misfit_rad > limit; });
  if (absolute) {
    std::vector<RankedTrial> unsplit;
    for (const RankedTrial& one : fitting)
      if (sample.split_lines(one.trial) <= kUnsplit) unsplit.push_back(one);
    fitting = std::move(unsplit);
  }
  if (fitting.empty()) return fitting;
  const double best = fitting.front().misfit_rad;
  std::erase_if(fitting, [&](const RankedTrial& one) { return one.misfit_rad > tie * best; });
  return fitting;
}

/// The pattern whose frames fit their shifts worst, if they are not in the declared order.
std::optional<std::size_t> misordered_map(const SequenceSample& sample, double& residual) {
  std::optional<std::size_t> worst;
  residual = kMaxFitResidual;
  for (std::size_t map = 0; map < sample.patterns().size(); ++map) {
    const double declared = sample.fit_residual(sample.patterns()[map], map);
    if (declared <= residual) continue;
    residual = declared;
    worst = map;
  }
  return worst;
}

/// The orders of the frames of one pattern that leave the least residual of the fringe fit. Orders
/// that reverse or delay the fringes leave the same residual.
std::vector<SequenceTrial> fitting_orders(const SequenceSample& sample,
                                          std::size_t map,
                                          double declared_residual) {
  constexpr double kSameResidual = 1.2;
  std::vector<std::pair<double, SequenceTrial>> found;
  double least = kFittedResidual * declared_residual;
  for (SequenceTrial& trial : shift_trials(sample.patterns(), map)) {
    if (trial.fault.kind != SequenceFaultKind::Order) continue;
    const double residual = sample.fit_residual(trial.changes.front().pattern, map);
    least = std::min(least, residual);
    found.emplace_back(residual, std::move(trial));
  }
  std::vector<SequenceTrial> trials;
  for (auto& [residual, trial] : found)
    if (residual <= kSameResidual * least) trials.push_back(std::move(trial));
  return trials;
}

SequenceCheck with_fits(SequenceCheck check, std::vector<RankedTrial> found) {
  if (!found.empty()) check.fitted_rad = found.front().misfit_rad;
  for (RankedTrial& one : found)
    check.fits.push_back(std::move(one.trial.fault));
  return check;
}

}  // namespace

SequenceCheck check_sequence(std::span<const SequenceFrames> coarse_to_fine,
                             const NoiseModel& noise,
                             const Projector& projector,
                             const WrapOptions& wrap,
                             const SequenceCheckOptions& options) {
  SequenceCheck out;
  for (const SequenceFrames& map : coarse_to_fine)
    out.patterns.push_back(map.stack->pattern.name);
  if (coarse_to_fine.empty()) return out;
  const SequenceSample sample(coarse_to_fine, noise, projector, wrap, options);
  if (sample.size() < options.min_pixels) return out;
  if (coarse_to_fine.size() > 1) {
    out.misfit_rad = sample.misfit();
    out.chance_rad = sample.chance();
    out.decided = sample.expected_misfit(kSystematic_rad) <= kMaxExpected * out.chance_rad;
  }
  const bool absolute = determine_absolute_phase(sample.patterns(), projector);
  std::vector<RankedTrial> found;
  double residual = 0.0;
  if (const auto map = misordered_map(sample, residual)) {
    std::vector<SequenceTrial> orders = fitting_orders(sample, *map, residual);
    if (out.decided) {
      found = plausible(sample,
                        fitting(sample, orders, options.max_misfit * out.chance_rad, options),
                        options.tie,
                        absolute);
    }
    if (found.empty()) {
      for (SequenceTrial& trial : orders)
        found.push_back({std::move(trial), 0.0});
    }
    out.decided = true;
    out.consistent = false;
    out.patterns = {sample.patterns()[*map].name};
    return with_fits(std::move(out), std::move(found));
  }
  const bool disagree = out.decided && out.misfit_rad > options.max_misfit * out.chance_rad;
  if (out.decided && !disagree && absolute) out.split_rows = sample.split_lines();
  if (!disagree && out.split_rows <= options.max_split_rows) return out;
  out.consistent = false;
  constexpr double kNotWorse = 1.3;  // misfit of a declaration that does not split the surface
  const double limit = out.misfit_rad * (disagree ? options.max_fitted : kNotWorse);
  found =
      plausible(sample, fitting(sample, all_trials(sample), limit, options), options.tie, absolute);
  if (disagree) {
    auto free = plausible(
        sample, fitting(sample, free_starts(sample, found), limit, options), options.tie, absolute);
    if (!free.empty()) found = std::move(free);
  }
  return with_fits(std::move(out), std::move(found));
}

}  // namespace frangia
