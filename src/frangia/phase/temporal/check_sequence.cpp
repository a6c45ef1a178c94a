#include "frangia/phase/temporal/check_sequence.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "frangia/phase/temporal/internal/rank_trials.h"
#include "frangia/phase/temporal/internal/sequence_sample.h"
#include "frangia/phase/temporal/internal/sequence_trials.h"
#include "frangia/phase/temporal/internal/start_offset.h"

namespace frangia {
namespace {

/// Residual of the fringe fit over the modulation above which the frames are in another order
/// though no order fits: a second harmonic of 0.35 (gamma 2.6) leaves up to 0.7 of four frames.
constexpr double kNoFringes = 0.8;

/// Systematic phase error of each pattern, rad RMS, that a sound sequence may have: harmonics of a
/// display, errors of steps. Three frames are blind to the second harmonic, which is 0.29 of the
/// first for gamma 2.2.
std::vector<double> largest_systematic(const std::vector<Pattern>& patterns) {
  constexpr double kThreeFrames_rad = 0.2;
  constexpr double kMoreFrames_rad = 0.05;
  std::vector<double> out;
  for (const Pattern& pattern : patterns)
    out.push_back(pattern.shifts_rad.size() <= 3 ? kThreeFrames_rad : kMoreFrames_rad);
  return out;
}

/// Largest expected misfit of a sound sequence, over chance, for which the check decides.
constexpr double kMaxExpected = 0.4;

/// Residual of the fringe fit over the modulation above which other orders are tried: frames of
/// another order have 0.5 and more, harmonics of 10 % leave 0.1.
constexpr double kMaxFitResidual = 0.3;
constexpr double kFittedResidual = 0.4;  ///< of a declaration that fits, over that of scan.toml

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

/// The result for a pattern whose frames have one of the orders, or none that is known.
SequenceCheck misordered(const SequenceSample& sample,
                         std::size_t map,
                         const std::vector<SequenceTrial>& orders,
                         SequenceCheck out,
                         const SequenceCheckOptions& options,
                         bool absolute) {
  std::vector<RankedTrial> found;
  if (out.decided) {
    found = plausible(sample,
                      fitting(sample, orders, options.max_misfit * out.chance_rad, options),
                      options,
                      absolute);
  }
  if (found.empty()) {
    for (const SequenceTrial& trial : orders)
      found.push_back({trial, 0.0});
  }
  out.decided = true;
  out.consistent = false;
  out.patterns = {sample.patterns()[map].name};
  return with_fits(std::move(out), std::move(found));
}

}  // namespace

SequenceCheck check_sequence(std::span<const SequenceFrames> coarse_to_fine,
                             const NoiseModel& noise,
                             const Projector& projector,
                             bool determines_orders,
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
    out.decided = out.misfit_rad <= options.max_misfit * out.chance_rad ||
                  sample.expected_misfit(largest_systematic(sample.patterns())) <=
                      kMaxExpected * out.chance_rad;
  }
  double residual = 0.0;
  if (const auto map = misordered_map(sample, residual)) {
    const std::vector<SequenceTrial> orders = fitting_orders(sample, *map, residual);
    // Without an order that fits, harmonics explain what is left of the frames.
    if (!orders.empty() || residual > kNoFringes)
      return misordered(sample, *map, orders, std::move(out), options, determines_orders);
  }
  const bool disagree = out.decided && out.misfit_rad > options.max_misfit * out.chance_rad;
  if (out.decided && !disagree && determines_orders) out.split_rows = sample.split_lines();
  if (!disagree && out.split_rows <= options.max_split_rows) {
    if (!out.decided || !determines_orders) return out;
    for (SequenceTrial& trial : trials_of_start_offset(sample))
      out.fits.push_back(std::move(trial.fault));
    out.consistent = out.fits.empty();
    return out;
  }
  out.consistent = false;
  constexpr double kNotWorse = 1.3;  // misfit of a declaration that does not split the surface
  const double limit = out.misfit_rad * (disagree ? options.max_fitted : kNotWorse);
  std::vector<RankedTrial> fits = fitting(sample, all_trials(sample), limit, options);
  if (disagree) fits = ranked(sample, with_free_starts(sample, std::move(fits)), limit, options);
  return with_fits(std::move(out), plausible(sample, std::move(fits), options, determines_orders));
}

}  // namespace frangia
