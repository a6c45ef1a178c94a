#include "frangia/registration/internal/assess_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "frangia/core/statistics.h"

namespace frangia {
namespace {

double violation_share(const PairTally& tally) {
  const std::size_t all = tally.agree + tally.violations;
  return all == 0 ? 0.0 : static_cast<double>(tally.violations) / static_cast<double>(all);
}

/// Largest share of a view's comparisons that violate free space, as if there were no view `left`.
double contradiction_without(const BundleSums& sums, const SurfelLists& surfels, std::size_t left) {
  double most = 0.0;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    if (view == left) continue;
    PairTally all;
    for (std::size_t other = 0; other < surfels.size(); ++other) {
      if (other == left) continue;
      all.add(sums.pair(view, other));
      all.add(sums.pair(other, view));
    }
    const double fewest = kMinOverlap * static_cast<double>(surfels[view].size());
    if (static_cast<double>(all.agree + all.violations) > fewest)
      most = std::max(most, violation_share(all));
  }
  return most;
}

}  // namespace

double rms_of(const std::vector<float>& distances) {
  double sum = 0.0;
  for (const float d : distances)
    sum += static_cast<double>(d) * static_cast<double>(d);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, distances.size())));
}

double overlap_of(const BundleSums& sums, const SurfelLists& surfels) {
  std::size_t all = 0;
  for (const auto& own : surfels)
    all += own.size();
  const std::size_t matched =
      std::accumulate(sums.matched.begin(), sums.matched.end(), std::size_t{0});
  return static_cast<double>(matched) / static_cast<double>(std::max<std::size_t>(1, all));
}

std::vector<std::size_t> find_outliers(const BundleSums& sums, double outlier_overlap) {
  std::vector<double> shares;
  for (std::size_t view = 0; view < sums.matched.size(); ++view) {
    const auto observed = static_cast<double>(sums.observed[view]);
    shares.push_back(observed > 0.0 ? static_cast<double>(sums.matched[view]) / observed : 1.0);
  }
  const double usual = median(shares);
  std::vector<std::size_t> outliers;
  for (std::size_t view = 0; view < shares.size(); ++view) {
    if (shares[view] < outlier_overlap * usual) outliers.push_back(view);
  }
  return outliers;
}

double free_space_violation(const BundleSums& sums) {
  PairTally all;
  for (const PairTally& region : sums.regions)
    all.add(region);
  return violation_share(all);
}

double contradiction_of(const BundleSums& sums, const SurfelLists& surfels) {
  return contradiction_without(sums, surfels, surfels.size());
}

std::optional<std::size_t> contradicting_view(const BundleSums& sums,
                                              const SurfelLists& surfels,
                                              double limit) {
  std::optional<std::size_t> found;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    if (surfels[view].empty() || contradiction_without(sums, surfels, view) > limit) continue;
    if (found) return std::nullopt;  // two views contradict each other, and no third decides
    found = view;
  }
  return found;
}

std::optional<std::size_t> disagreeing_view(const BundleSums& sums) {
  constexpr double kExplains = 0.75;   // of what is more than noise, by the pairs of the view
  constexpr double kOtherViews = 0.5;  // at most, by those of any other view
  const std::size_t views = sums.matched.size();
  // Chi squared of the mean distances of regions, less its expectation. Each pair counts for both.
  std::vector<double> of_view(views, 0.0);
  double all = 0.0;
  for (std::size_t from = 0; from < views; ++from) {
    for (std::size_t to = 0; to < views; ++to) {
      for (std::size_t region = 0; region < kRegionsPerView; ++region) {
        const PairTally& pair = sums.regions[kRegionsPerView * (from * views + to) + region];
        if (!(pair.weight > 0.0)) continue;
        const double excess = pair.weighted_mm * pair.weighted_mm / pair.weight - 1.0;
        all += excess;
        of_view[from] += excess;
        of_view[to] += excess;
      }
    }
  }
  const auto most = std::max_element(of_view.begin(), of_view.end());
  if (!(all > 0.0) || *most < kExplains * all) return std::nullopt;
  const auto view = static_cast<std::size_t>(most - of_view.begin());
  of_view.erase(most);
  if (of_view.empty() || *std::max_element(of_view.begin(), of_view.end()) > kOtherViews * all)
    return std::nullopt;
  return view;
}

}  // namespace frangia
