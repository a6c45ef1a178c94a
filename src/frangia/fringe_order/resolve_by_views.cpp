#include "frangia/fringe_order/resolve_by_views.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Criteria for the fringe order that other views confirm.
struct ResolveByViewsLimits {
  int max_samples = 400;        ///< maximum number of compared points of a region
  double tolerance = 0.06;      ///< distance that counts as agreement, per fringe spacing
  double min_agreement = 0.15;  ///< minimum score of the best order, per compared point
  double max_runner_up = 0.5;   ///< maximum score of the second best order, per best score
};
constexpr ResolveByViewsLimits kResolveLimits;

/// Smaller regions are removed without a comparison.
constexpr std::size_t kMinRegion_px = 30;

struct RegionCandidates {
  const UnresolvedViewRegion* unresolved = nullptr;
  std::vector<FringeOrderCandidate> candidates;
  bool resolved = false;
};

/// The candidate that other views confirm and that no other one rivals, or null.
const FringeOrderCandidate* best_candidate(const RegionCandidates& region) {
  const FringeOrderCandidate* best = nullptr;
  const FringeOrderCandidate* second = nullptr;
  for (const FringeOrderCandidate& candidate : region.candidates) {
    if (best == nullptr || candidate.score() > best->score()) {
      second = best;
      best = &candidate;
    } else if (second == nullptr || candidate.score() > second->score()) {
      second = &candidate;
    }
  }
  if (best == nullptr) return nullptr;
  const auto points = static_cast<double>(best->points_mm.size());
  if (best->score() < kResolveLimits.min_agreement * points) return nullptr;
  const bool ambiguous =
      second != nullptr && second->score() > kResolveLimits.max_runner_up * best->score();
  return ambiguous ? nullptr : best;
}

void add_to_view(const UnresolvedViewRegion& unresolved,
                 int order,
                 const FringeComparison& comparison,
                 ViewStore& views) {
  View view = views.load(unresolved.view);
  const UnresolvedRegion& region = unresolved.region;
  for (std::size_t i = 0; i < region.pixel.size(); ++i) {
    const int x = static_cast<int>(region.pixel[i]) % view.range.depth_mm.width();
    const int y = static_cast<int>(region.pixel[i]) / view.range.depth_mm.width();
    const Eigen::Vector2d ray = comparison.rays(x, y).cast<double>();
    const auto phase = static_cast<float>(region.phase_rad[i] + kTwoPi * order);
    const RayDepth found =
        intersect_fringe(ray, phase, comparison.pattern, comparison.rig.projector);
    if (std::isnan(found.depth_mm)) continue;
    const double mm_per_rad = std::abs(found.mm_per_rad) * std::sqrt(1.0 + ray.squaredNorm());
    const float systematic_rad =
        region.systematic_rad.empty() ? kMissing : region.systematic_rad[i];
    view.range.set({x,
                    y,
                    static_cast<float>(found.depth_mm),
                    static_cast<float>(mm_per_rad * region.sigma_rad[i]),
                    phase,
                    static_cast<float>(mm_per_rad * systematic_rad)});
  }
  views.replace(unresolved.view, view);
}

/// Compares the unresolved regions with every view once; returns the number of resolved points.
std::size_t resolve_once(ViewStore& views,
                         std::vector<RegionCandidates>& regions,
                         const FringeComparison& comparison,
                         const Run& run) {
  for (RegionCandidates& region : regions) {
    for (FringeOrderCandidate& candidate : region.candidates)
      candidate.agree = candidate.violations = candidate.unseen = 0;
  }
  for (std::size_t other = 0; other < views.size(); ++other) {
    run.check();
    const Image<float> depth_mm = views.load_depth_mm(other);
    parallel_chunks(regions.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (regions[i].resolved || regions[i].unresolved->view == other) continue;
        for (FringeOrderCandidate& candidate : regions[i].candidates)
          compare_with(depth_mm, views.rig_from_object(other), comparison, candidate);
      }
    });
  }
  std::size_t resolved = 0;
  for (RegionCandidates& region : regions) {
    const FringeOrderCandidate* best = region.resolved ? nullptr : best_candidate(region);
    if (best == nullptr) continue;
    add_to_view(*region.unresolved, best->order, comparison, views);
    region.resolved = true;
    resolved += region.unresolved->region.pixel.size();
  }
  return resolved;
}

}  // namespace

ResolveByViewsResult resolve_by_views(ViewStore& views,
                                      const std::vector<UnresolvedViewRegion>& unresolved,
                                      const FringeOptics& optics,
                                      const Run& run) {
  const FringeComparison comparison{optics, kResolveLimits.tolerance, kResolveLimits.max_samples};
  ResolveByViewsResult result;
  std::vector<RegionCandidates> regions;
  for (const UnresolvedViewRegion& one : unresolved) {
    result.removed_points += one.region.pixel.size();
    if (one.region.pixel.size() < kMinRegion_px) continue;
    const FringePixels pixels{one.region.pixel, one.region.phase_rad};
    regions.push_back(
        {&one, fringe_order_candidates(pixels, views.rig_from_object(one.view), comparison)});
  }
  while (const std::size_t resolved = resolve_once(views, regions, comparison, run)) {
    result.resolved_points += resolved;
    result.removed_points -= resolved;
  }
  return result;
}

std::vector<FringeOrderCandidate> fringe_order_candidates(const FringePixels& pixels,
                                                          const Eigen::Isometry3d& rig_from_object,
                                                          const FringeComparison& comparison) {
  std::vector<FringeOrderCandidate> candidates;
  if (pixels.pixel.empty()) return candidates;
  const auto [low, high] = std::minmax_element(pixels.phase_rad.begin(), pixels.phase_rad.end());
  const PhaseRange lit = phase_range(comparison.pattern, comparison.rig.projector);
  const int first = static_cast<int>(std::floor((lit.min_rad - *high) / kTwoPi));
  const int last = static_cast<int>(std::ceil((lit.max_rad - *low) / kTwoPi));
  const std::size_t stride = std::max<std::size_t>(
      1, pixels.pixel.size() / static_cast<std::size_t>(comparison.max_samples));
  const Eigen::Isometry3d object_from_rig = rig_from_object.inverse();
  for (int order = first; order <= last; ++order) {
    FringeOrderCandidate candidate{.order = order};
    std::size_t tried = 0;
    for (std::size_t i = 0; i < pixels.pixel.size(); i += stride) {
      ++tried;
      const double phase = pixels.phase_rad[i] + kTwoPi * order;
      if (phase < lit.min_rad || phase > lit.max_rad) continue;
      const Eigen::Vector2d ray = comparison.rays.pixels()[pixels.pixel[i]].cast<double>();
      const RayDepth found =
          intersect_fringe(ray, phase, comparison.pattern, comparison.rig.projector);
      if (std::isnan(found.depth_mm)) continue;
      const Eigen::Vector3d point = found.depth_mm * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
      candidate.points_mm.emplace_back((object_from_rig * point).cast<float>());
      candidate.spacing_mm = std::abs(found.mm_per_rad) * kTwoPi;
    }
    if (2 * candidate.points_mm.size() > tried) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

void compare_with(const Image<float>& depth_mm,
                  const Eigen::Isometry3d& rig_from_object,
                  const FringeComparison& comparison,
                  FringeOrderCandidate& candidate) {
  const double tolerance = comparison.tolerance * candidate.spacing_mm;
  for (const Eigen::Vector3f& point : candidate.points_mm) {
    const Eigen::Vector3d seen = rig_from_object * point.cast<double>();
    if (!(seen.z() > 0.0)) continue;
    const Eigen::Vector2d pixel = comparison.rig.reference().model.project(seen);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    if (x < 0 || y < 0 || x >= depth_mm.width() || y >= depth_mm.height()) continue;
    const double in_front = depth_mm(x, y) - seen.z();
    if (std::isnan(in_front)) ++candidate.unseen;
    if (std::abs(in_front) <= tolerance) ++candidate.agree;
    if (in_front > 2.0 * tolerance) ++candidate.violations;
  }
}

}  // namespace frangia
