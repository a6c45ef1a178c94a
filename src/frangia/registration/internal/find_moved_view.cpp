#include "frangia/registration/internal/find_moved_view.h"

#include <algorithm>
#include <numeric>

namespace frangia {
namespace {

double violation_share(const PairTally& tally) {
  const std::size_t all = tally.agree + tally.violations;
  return all == 0 ? 0.0 : static_cast<double>(tally.violations) / static_cast<double>(all);
}

/// The views to leave out in turn, those with the most violations first; none when no view is
/// suspicious.
std::vector<std::size_t> moved_view_candidates(const BundleSums& sums,
                                               const MovedViewOptions& options) {
  std::vector<std::size_t> candidates(sums.matched.size());
  std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  std::stable_sort(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) {
    return free_space_violation(sums, a) > free_space_violation(sums, b);
  });
  if (free_space_violation(sums, candidates.front()) < options.suspicious_violation) return {};
  candidates.resize(std::min(candidates.size(), options.max_candidates));
  return candidates;
}

/// The violations that remain without a view.
struct Trial {
  std::size_t view = 0;
  double violation = 0.0;
};

Trial try_without(std::size_t view,
                  Bundle& bundle,
                  const SurfelLists& surfels,
                  const MovedViewOptions& options,
                  const Run& run) {
  bundle.left_out = view;
  bundle.state = bundle.given;
  bundle.gate_mm = options.reach_mm;
  optimize_bundle(bundle, surfels, options.max_iterations, run);
  return {view, free_space_violation(sum(bundle, surfels))};
}

}  // namespace

double free_space_violation(const BundleSums& sums, std::size_t view) {
  PairTally all;
  for (std::size_t other = 0; other < sums.matched.size(); ++other) {
    all.add(sums.pair(view, other));
    all.add(sums.pair(other, view));
  }
  return violation_share(all);
}

double free_space_violation(const BundleSums& sums) {
  PairTally all;
  for (const PairTally& region : sums.regions)
    all.add(region);
  return violation_share(all);
}

std::optional<MovedView> find_moved_view(Bundle& bundle,
                                         const SurfelLists& surfels,
                                         const MovedViewOptions& options,
                                         const Run& run) {
  const BundleSums all_views = sum(bundle, surfels);
  const std::vector<std::size_t> candidates = moved_view_candidates(all_views, options);
  if (candidates.empty()) return std::nullopt;
  const TableState state = bundle.state;
  const double gate_mm = bundle.gate_mm;
  std::vector<Trial> trials;
  trials.reserve(candidates.size());
  for (const std::size_t view : candidates)
    trials.push_back(try_without(view, bundle, surfels, options, run));
  bundle.left_out.reset();
  bundle.state = state;
  bundle.gate_mm = gate_mm;
  std::stable_sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    return a.violation < b.violation;
  });
  if (trials[0].violation > options.max_remaining * free_space_violation(all_views))
    return std::nullopt;
  MovedView moved{trials[0].view, std::nullopt};
  if (trials.size() > 1 && trials[1].violation < options.no_violation)
    moved.alternative = trials[1].view;
  return moved;
}

}  // namespace frangia
