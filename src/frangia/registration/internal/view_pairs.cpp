#include "frangia/registration/internal/view_pairs.h"

#include <algorithm>
#include <numeric>

#include "frangia/core/parallel.h"
#include "frangia/registration/internal/surfel_pair.h"

namespace frangia {
namespace {

/// Views that each view picks. `./run figures views` prints the refined axis of 96 views, which
/// pick, and of 24 views, which are all compared with each other.
constexpr std::size_t kPicked = 12;
constexpr std::size_t kNeighbors = 2;      // nearest by rotation, always among the picked ones
constexpr std::size_t kProbes = 128;       // surfels of a view that measure its overlap
constexpr double kMinVisibleShare = 0.05;  // of the probes; fewer are chance

/// Share of a view's surfels that face another view and project onto a surface that it measured.
double visible_share(const std::vector<SurfelMap::Surfel>& probes,
                     const SurfelMap& other,
                     const FastCameraModel& model,
                     const Eigen::Isometry3d& other_from_own) {
  std::size_t visible = 0;
  for (const SurfelMap::Surfel& surfel : probes) {
    const Eigen::Vector3d point = other_from_own * surfel.point_mm.cast<double>();
    const Eigen::Vector3d facing = other_from_own.linear() * surfel.normal.cast<double>();
    if (facing.dot(point) < 0.0 && surfel_at(other, model, point) != nullptr) ++visible;
  }
  return static_cast<double>(visible) /
         static_cast<double>(std::max<std::size_t>(1, probes.size()));
}

/// The views that overlap with a view, the least rotated one first.
std::vector<std::size_t> overlapping_views(std::size_t own,
                                           const std::vector<SurfelMap::Surfel>& probes,
                                           std::span<const SurfelMap> maps,
                                           const FastCameraModel& model,
                                           std::span<const Eigen::Isometry3d> rig_from_part) {
  struct Candidate {
    double rotation_rad;
    std::size_t view;
  };
  std::vector<Candidate> candidates;
  const Eigen::Isometry3d part_from_own = rig_from_part[own].inverse();
  for (std::size_t other = 0; other < maps.size(); ++other) {
    if (other == own) continue;
    const Eigen::Isometry3d other_from_own = rig_from_part[other] * part_from_own;
    if (visible_share(probes, maps[other], model, other_from_own) < kMinVisibleShare) continue;
    candidates.push_back({Eigen::AngleAxisd(other_from_own.linear()).angle(), other});
  }
  std::stable_sort(
      candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.rotation_rad < b.rotation_rad;
      });
  std::vector<std::size_t> views;
  for (const Candidate& candidate : candidates)
    views.push_back(candidate.view);
  return views;
}

/// The first views, and others spread evenly over the rest.
std::vector<std::size_t> pick_spread(const std::vector<std::size_t>& views) {
  if (views.size() <= kPicked) return views;
  std::vector<std::size_t> picked(views.begin(),
                                  views.begin() + static_cast<std::ptrdiff_t>(kNeighbors));
  const std::size_t others = kPicked - kNeighbors;
  const std::size_t last = views.size() - 1 - kNeighbors;
  for (std::size_t i = 0; i < others; ++i)
    picked.push_back(views[kNeighbors + i * last / (others - 1)]);
  return picked;
}

}  // namespace

ViewPairs all_view_pairs(std::size_t views) {
  ViewPairs pairs(views);
  for (std::size_t own = 0; own < views; ++own) {
    for (std::size_t other = 0; other < views; ++other)
      if (other != own) pairs[own].push_back(other);
  }
  return pairs;
}

ViewPairs choose_view_pairs(std::span<const SurfelMap> maps,
                            const FastCameraModel& model,
                            std::span<const Eigen::Isometry3d> rig_from_part) {
  const std::size_t views = maps.size();
  if (views <= kMaxFullViews) return all_view_pairs(views);
  std::vector<std::vector<std::size_t>> picked(views);
  parallel_chunks(views, 1, [&](std::size_t own, std::size_t /*end*/) {
    picked[own] = pick_spread(
        overlapping_views(own, pick_surfels(maps[own], kProbes), maps, model, rig_from_part));
  });
  ViewPairs pairs(views);
  for (std::size_t own = 0; own < views; ++own) {
    for (const std::size_t other : picked[own])
      add_view_pair(pairs, own, other);
  }
  return pairs;
}

void add_view_pair(ViewPairs& pairs, std::size_t a, std::size_t b) {
  const auto insert = [&](std::size_t own, std::size_t other) {
    std::vector<std::size_t>& others = pairs[own];
    const auto at = std::lower_bound(others.begin(), others.end(), other);
    if (at == others.end() || *at != other) others.insert(at, other);
  };
  insert(a, b);
  insert(b, a);
}

std::size_t count_pairs(const ViewPairs& pairs) {
  return std::accumulate(
      pairs.begin(), pairs.end(), std::size_t{0}, [](std::size_t sum, const auto& others) {
        return sum + others.size();
      });
}

std::size_t surfels_per_view(std::size_t most, std::size_t views) {
  return views <= kMaxFullViews ? most : most * kMaxFullViews / views;
}

}  // namespace frangia
