#include "frangia/views/find_moved_view.h"

#include <algorithm>
#include <numeric>

namespace frangia {
namespace {

double share(const PairTally& tally) {
  const std::size_t all = tally.agree + tally.against;
  return all == 0 ? 0.0 : static_cast<double>(tally.against) / static_cast<double>(all);
}

void add(PairTally& sum, const PairTally& tally) {
  sum.agree += tally.agree;
  sum.against += tally.against;
}

/// Views to be left out in turn, those that others contradict most first; none when there is no
/// contradiction at all. A view that moved bends the bundle towards itself, and may look innocent.
std::vector<std::size_t> suspects_of(const BundleSums& sums) {
  constexpr double kNoticed = 0.02;  // ten times what edges and stray points come to
  constexpr std::size_t kMost = 10;
  std::vector<std::size_t> suspects(sums.met.size());
  std::iota(suspects.begin(), suspects.end(), std::size_t{0});
  std::stable_sort(suspects.begin(), suspects.end(), [&](std::size_t a, std::size_t b) {
    return contradiction_of(sums, a) > contradiction_of(sums, b);
  });
  if (contradiction_of(sums, suspects.front()) < kNoticed) return {};
  suspects.resize(std::min(suspects.size(), kMost));
  return suspects;
}

/// What is left of the contradiction without a view.
struct Trial {
  std::size_t view = 0;
  double rest = 0.0;
};

Trial try_without(std::size_t view,
                  Bundle& bundle,
                  const Spots& spots,
                  const MovedViewOptions& options,
                  const Run& run) {
  bundle.left_out = view;
  bundle.state = bundle.given;
  bundle.gate_mm = options.reach_mm;
  settle(bundle, spots, options.max_iterations, run);
  return {view, contradiction(sum(bundle, spots))};
}

}  // namespace

double contradiction_of(const BundleSums& sums, std::size_t view) {
  PairTally all;
  for (std::size_t other = 0; other < sums.met.size(); ++other) {
    add(all, sums.pair(view, other));
    add(all, sums.pair(other, view));
  }
  return share(all);
}

double contradiction(const BundleSums& sums) {
  PairTally all;
  for (const PairTally& pair : sums.pairs)
    add(all, pair);
  return share(all);
}

std::optional<MovedView> find_moved_view(Bundle& bundle,
                                         const Spots& spots,
                                         const MovedViewOptions& options,
                                         const Run& run) {
  constexpr double kBetter = 0.7;  // of the contradiction: one of several moved views takes less
  constexpr double kAsGood = 0.005;
  const BundleSums whole = sum(bundle, spots);
  const std::vector<std::size_t> suspects = suspects_of(whole);
  if (suspects.empty()) return std::nullopt;
  const TableState state = bundle.state;
  const double gate_mm = bundle.gate_mm;
  std::vector<Trial> trials;
  trials.reserve(suspects.size());
  for (const std::size_t view : suspects)
    trials.push_back(try_without(view, bundle, spots, options, run));
  bundle.left_out.reset();
  bundle.state = state;
  bundle.gate_mm = gate_mm;
  std::stable_sort(
      trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.rest < b.rest; });
  if (trials[0].rest > kBetter * contradiction(whole)) return std::nullopt;
  MovedView moved{trials[0].view, std::nullopt};
  if (trials.size() > 1 && trials[1].rest < kAsGood) moved.rival = trials[1].view;
  return moved;
}

}  // namespace frangia
