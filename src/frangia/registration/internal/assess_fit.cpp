#include "frangia/registration/internal/assess_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "frangia/core/median.h"

namespace frangia {
namespace {

double violation_share(const PairTally& tally) {
  const std::size_t all = tally.agree + tally.violations;
  return all == 0 ? 0.0 : static_cast<double>(tally.violations) / static_cast<double>(all);
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
  double most = 0.0;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    PairTally all;
    for (std::size_t other = 0; other < surfels.size(); ++other) {
      all.add(sums.pair(view, other));
      all.add(sums.pair(other, view));
    }
    const double fewest = kMinOverlap * static_cast<double>(surfels[view].size());
    if (static_cast<double>(all.agree + all.violations) > fewest)
      most = std::max(most, violation_share(all));
  }
  return most;
}

}  // namespace frangia
