#include "frangia/phase/temporal/internal/rank_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Share of the rows in which the ends of the field may meet with a declaration that fits.
constexpr double kUnsplit = 0.05;

/// Whole periods in projector pixels, for frames whose period the other patterns do not show.
void add_whole_periods(std::span<const Pattern> patterns,
                       std::size_t map,
                       std::vector<SequenceTrial>& trials) {
  constexpr int kFinest_px = 4;
  constexpr int kMost = 60;  // periods tried
  const double declared_px = patterns[map].period_px;
  for (int k = 0; k < kMost && kFinest_px + k <= 3.0 * declared_px; ++k) {
    const double period_px = kFinest_px + k;
    if (std::abs(period_px - declared_px) > 1e-3 * declared_px)
      trials.push_back(period_trial(patterns, map, 1.0 / period_px));
  }
}

/// The period that the frames show, rounded as far as the misfit stays the same.
void add_shown_period(const SequenceSample& sample,
                      std::size_t map,
                      std::vector<SequenceTrial>& trials) {
  const double shown = sample.shown_frequency(map);
  if (shown == 0.0) {
    add_whole_periods(sample.patterns(), map, trials);
    return;
  }
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

/// The starts of one map that fit best, to a degree. Starts may fit alike, as those half a fringe
/// apart where the fringes of that map come in pairs in every relation of the phases.
std::vector<SequenceTrial> free_starts(const SequenceSample& sample, std::size_t map) {
  constexpr std::size_t kRefined = 6;       // minima
  constexpr double kAlike = 1.1;            // misfit over the least one
  using Start = std::pair<double, double>;  // misfit, degrees
  const auto look = [&](double from_deg, double to_deg, double step_deg) {
    std::vector<Start> found;
    for (int i = 0; from_deg + i * step_deg <= to_deg; ++i) {
      const double start_deg = from_deg + i * step_deg;
      if (std::remainder(start_deg, 360.0) == 0.0) continue;  // as declared
      const SequenceTrial trial = start_trial(sample.patterns(), map, rad_from_deg(start_deg));
      found.emplace_back(sample.misfit(trial), start_deg);
    }
    return found;
  };
  const std::vector<Start> coarse = look(10.0, 350.0, 10.0);
  std::vector<Start> minima;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const bool falls = i == 0 || coarse[i].first <= coarse[i - 1].first;
    const bool rises = i + 1 == coarse.size() || coarse[i].first <= coarse[i + 1].first;
    if (falls && rises) minima.push_back(coarse[i]);
  }
  std::stable_sort(minima.begin(), minima.end());
  minima.resize(std::min(kRefined, minima.size()));
  for (Start& minimum : minima) {
    for (const double step_deg : {2.0, 1.0}) {
      const double reach_deg = 4.0 * step_deg;
      const auto near = look(minimum.second - reach_deg, minimum.second + reach_deg, step_deg);
      minimum = *std::min_element(near.begin(), near.end());
    }
  }
  std::stable_sort(minima.begin(), minima.end());
  std::vector<SequenceTrial> out;
  for (const auto& [misfit, start_deg] : minima) {
    if (misfit <= kAlike * minima.front().first)
      out.push_back(start_trial(sample.patterns(), map, rad_from_deg(start_deg)));
  }
  return out;
}

/// Independent witnesses of a misfit. The medians of the pixels differ by 1.5 % by chance; what is
/// beyond the noise, such as harmonics or indirect light, is a field over the image.
double witnesses_of(const SequenceSample& sample, double best_misfit_rad) {
  constexpr double kOfNoise = 60.0;
  constexpr double kOfFields = 25.0;
  constexpr double kNoise = 1.2;  // times the misfit of noise alone
  return best_misfit_rad <= kNoise * sample.expected_misfit() ? kOfNoise : kOfFields;
}

/// Logarithm of the evidence for a declaration: the density of normal residuals of its misfit in
/// all maps but one, which the place in the field takes, and a prior of 0.01 for each fault.
double log_evidence(const RankedTrial& one, double witnesses, std::size_t maps) {
  constexpr double kLeast_rad = 1e-4;  // exact phases
  constexpr double kPriorFault = 0.01;
  const auto freedom = static_cast<double>(std::max<std::size_t>(maps, 2) - 1);
  const double faults = one.trial.fault.is_compound ? 2.0 : 1.0;
  return faults * std::log(kPriorFault) -
         witnesses * freedom * std::log(std::max(one.misfit_rad, kLeast_rad));
}

}  // namespace

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

std::vector<RankedTrial> ranked(const SequenceSample& sample,
                                std::vector<RankedTrial> trials,
                                double max_misfit_rad,
                                const SequenceCheckOptions& options) {
  std::vector<RankedTrial> kept;
  for (RankedTrial& one : trials) {
    if (one.misfit_rad > max_misfit_rad ||
        one.misfit_rad > options.max_misfit * sample.chance(one.trial))
      continue;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const RankedTrial& other) {
      return other.trial.fault.patterns == one.trial.fault.patterns &&
             other.trial.fault.keys == one.trial.fault.keys;
    });
    if (!known) kept.push_back(std::move(one));
  }
  std::stable_sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    return a.misfit_rad < b.misfit_rad;
  });
  return kept;
}

std::vector<RankedTrial> fitting(const SequenceSample& sample,
                                 std::vector<SequenceTrial> trials,
                                 double max_misfit_rad,
                                 const SequenceCheckOptions& options) {
  std::vector<RankedTrial> fitting;
  for (SequenceTrial& trial : trials) {
    const double misfit = sample.misfit(trial);
    if (misfit <= max_misfit_rad) fitting.push_back({std::move(trial), misfit});
  }
  return ranked(sample, std::move(fitting), max_misfit_rad, options);
}

std::vector<RankedTrial> with_free_starts(const SequenceSample& sample,
                                          std::vector<RankedTrial> found) {
  constexpr double kNoise = 1.3;   // times the misfit of noise alone
  constexpr double kBetter = 0.8;  // misfit of a free start over the best of the others
  const double best = found.empty() ? std::numeric_limits<double>::max() : found.front().misfit_rad;
  if (best <= kNoise * sample.expected_misfit()) return found;
  for (std::size_t map = 0; map < sample.patterns().size(); ++map) {
    for (SequenceTrial& trial : free_starts(sample, map)) {
      const double misfit = sample.misfit(trial);
      if (misfit < kBetter * best) found.push_back({std::move(trial), misfit});
    }
  }
  return found;
}

std::vector<RankedTrial> plausible(const SequenceSample& sample,
                                   std::vector<RankedTrial> fitting,
                                   bool absolute) {
  if (fitting.empty()) return fitting;
  const double witnesses = witnesses_of(sample, fitting.front().misfit_rad);
  const auto evidence = [&](const RankedTrial& one) {
    return log_evidence(one, witnesses, sample.patterns().size());
  };
  std::stable_sort(fitting.begin(), fitting.end(), [&](const auto& a, const auto& b) {
    return evidence(a) > evidence(b);
  });
  const double odds = std::log(100.0);  // from which on a declaration loses
  std::vector<RankedTrial> out;
  for (RankedTrial& one : fitting) {
    if (!out.empty() && evidence(one) <= evidence(out.front()) - odds) break;
    if (!absolute || sample.split_lines(one.trial) <= kUnsplit) out.push_back(std::move(one));
  }
  return out;
}

}  // namespace frangia
