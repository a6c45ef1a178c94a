#include "frangia/reconstruct/internal/assess_merge.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/registration/compare_groups.h"

namespace frangia {
namespace {

/// Sums over all comparisons of one scan with the others.
struct ScanTally {
  double agree = 0.0;
  double violations = 0.0;
  double close = 0.0;        ///< points within the reach of the registration
  double distance_mm = 0.0;  ///< median distances of the pairs, weighted by their close points

  void add(const GroupFit& strict, const GroupFit& wide) {
    agree += static_cast<double>(strict.agree);
    violations += static_cast<double>(strict.violations);
    close += static_cast<double>(wide.agree);
    distance_mm += static_cast<double>(wide.agree) * wide.residual_mm;
  }
};

/// The points of each scan in its present pose.
std::vector<ViewGroup> groups_of(const ViewStore& views, std::span<const SurfelMap> maps) {
  std::vector<std::vector<ViewGroup::Member>> members;
  for (std::size_t i = 0; i < views.size(); ++i)
    members.push_back({{i, views.rig_from_object(i)}});
  const double spacing_mm = spacing_for(members, maps);
  std::vector<ViewGroup> groups;
  for (auto& member : members)
    groups.push_back(make_group(std::move(member), maps, spacing_mm));
  return groups;
}

/// Scans of which each shares surface with another one of the same part of them.
class Connected {
 public:
  explicit Connected(std::size_t scans) : of_(scans) {
    std::iota(of_.begin(), of_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t from = of_[b];
    const std::size_t to = of_[a];
    std::replace(of_.begin(), of_.end(), from, to);
  }
  /// Those that are not in the largest part, but for `empty` ones.
  [[nodiscard]] std::vector<std::size_t> apart(const std::vector<ViewGroup>& groups) const {
    std::vector<std::size_t> sizes(of_.size(), 0);
    for (std::size_t i = 0; i < of_.size(); ++i)
      sizes[of_[i]] += groups[i].points.size() > 0 ? 1U : 0U;
    const auto largest =
        static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < of_.size(); ++i)
      if (of_[i] != largest && groups[i].points.size() > 0) others.push_back(i);
    return others;
  }

 private:
  std::vector<std::size_t> of_;
};

}  // namespace

MergeFit compare_scans(const ViewStore& views,
                       std::span<const SurfelMap> maps,
                       const CameraModel& camera,
                       const ScanQuality& quality,
                       const MergeScansOptions& options) {
  MergeFit fit;
  fit.tolerance_mm = std::max(options.max_residual_sigmas * quality.noise_mm,
                              options.max_residual_spacings * quality.spacing_mm);
  const RegisterPosesOptions& registration = options.registration;
  const double reach_mm =
      std::max(2.0 * fit.tolerance_mm,
               registration.reach_mm > 0.0 ? registration.reach_mm : default_reach_mm(maps));
  const std::vector<ViewGroup> groups = groups_of(views, maps);
  const FastCameraModel model(camera);
  const GroupViews all{maps, model};
  const Eigen::Isometry3d same = Eigen::Isometry3d::Identity();
  std::vector<ScanTally> tallies(groups.size());
  Connected connected(groups.size());
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      const GroupFit strict = compare_groups(groups[a], groups[b], same, all, fit.tolerance_mm);
      const GroupFit wide = compare_groups(groups[a], groups[b], same, all, reach_mm);
      tallies[a].add(strict, wide);
      tallies[b].add(strict, wide);
      if (wide.overlap >= registration.min_overlap) connected.join(a, b);
    }
  }
  fit.apart = connected.apart(groups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ScanTally& tally = tallies[i];
    const double fewest = registration.min_overlap * static_cast<double>(groups[i].points.size());
    const double compared = tally.agree + tally.violations;
    if (compared > fewest && tally.violations > fit.contradiction * compared) {
      fit.contradiction = tally.violations / compared;
      fit.contradicting_scan = i;
    }
    if (tally.close > fewest && tally.distance_mm > fit.residual_mm * tally.close) {
      fit.residual_mm = tally.distance_mm / tally.close;
      fit.residual_scan = i;
    }
  }
  return fit;
}

std::string untrusted_merge_reason(const MergeFit& fit,
                                   std::span<const std::string> names,
                                   const MergeScansOptions& options) {
  constexpr const char* kCause =
      "either their poses are wrong, or the scans do not show the same unchanged part at the same "
      "scale";
  if (fit.contradiction > options.max_contradiction) {
    return fmt::format(
        "the scans contradict each other, {:.0f} % of the compared points of {} lie in front of "
        "the surface that another scan measured, or behind it: {}",
        100.0 * fit.contradiction,
        names[fit.contradicting_scan],
        kCause);
  }
  if (fit.residual_mm > fit.tolerance_mm) {
    return fmt::format(
        "the scans contradict each other, {} deviates from the others by {:.2g} mm in the median, "
        "and noise and sampling explain {:.2g} mm: {}",
        names[fit.residual_scan],
        fit.residual_mm,
        fit.tolerance_mm,
        kCause);
  }
  return {};
}

}  // namespace frangia
