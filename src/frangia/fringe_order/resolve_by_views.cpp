#include "frangia/fringe_order/resolve_by_views.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

struct RegionCandidates {
  const UnresolvedViewRegion* part = nullptr;
  std::vector<FringeOrderCandidate> candidates;
  bool resolved = false;
};

/// The candidate that other views confirm and that no other one rivals, or null.
const FringeOrderCandidate* best_candidate(const RegionCandidates& one,
                                           const ResolveByViewsOptions& options) {
  const FringeOrderCandidate* best = nullptr;
  const FringeOrderCandidate* second = nullptr;
  for (const FringeOrderCandidate& candidate : one.candidates) {
    if (best == nullptr || candidate.score() > best->score()) {
      second = best;
      best = &candidate;
    } else if (second == nullptr || candidate.score() > second->score()) {
      second = &candidate;
    }
  }
  if (best == nullptr) return nullptr;
  const auto points = static_cast<double>(best->points_mm.size());
  if (best->score() < options.min_agreement * points) return nullptr;
  const bool ambiguous =
      second != nullptr && second->score() > options.max_runner_up * best->score();
  return ambiguous ? nullptr : best;
}

void add_to_view(const UnresolvedViewRegion& part,
                 int fringes,
                 const FringeComparison& set,
                 ViewStore& views) {
  View view = views.load(part.view);
  for (std::size_t i = 0; i < part.region.pixel.size(); ++i) {
    const std::uint32_t pixel = part.region.pixel[i];
    const Eigen::Vector2d ray = set.rays.pixels()[pixel].cast<double>();
    const double phase = part.region.phase_rad[i] + kTwoPi * fringes;
    const RayDepth found = intersect_fringe(ray, phase, set.pattern, set.rig.projector);
    if (std::isnan(found.depth_mm)) continue;
    view.range.depth_mm.pixels()[pixel] = static_cast<float>(found.depth_mm);
    view.range.sigma_mm.pixels()[pixel] = static_cast<float>(
        std::abs(found.mm_per_rad) * part.region.sigma_rad[i] * std::sqrt(1.0 + ray.squaredNorm()));
  }
  views.replace(part.view, view);
}

/// Compares the unresolved regions with every view once; returns the number of resolved points.
std::size_t one_pass(ViewStore& views,
                     std::vector<RegionCandidates>& cases,
                     const FringeComparison& set,
                     const ResolveByViewsOptions& options,
                     const Run& run) {
  for (RegionCandidates& one : cases) {
    for (FringeOrderCandidate& candidate : one.candidates)
      candidate.agree = candidate.violations = candidate.unseen = 0;
  }
  for (std::size_t other = 0; other < views.size(); ++other) {
    run.check();
    const View view = views.load(other);
    parallel_chunks(cases.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (cases[i].resolved || cases[i].part->view == other) continue;
        for (FringeOrderCandidate& candidate : cases[i].candidates)
          compare_with(view, set, candidate);
      }
    });
  }
  std::size_t resolved = 0;
  for (RegionCandidates& one : cases) {
    const FringeOrderCandidate* best = one.resolved ? nullptr : best_candidate(one, options);
    if (best == nullptr) continue;
    add_to_view(*one.part, best->order, set, views);
    one.resolved = true;
    resolved += one.part->region.pixel.size();
  }
  return resolved;
}

}  // namespace

ResolveByViewsResult resolve_by_views(ViewStore& views,
                                      const std::vector<UnresolvedViewRegion>& unresolved,
                                      const FringeOptics& optics,
                                      const ResolveByViewsOptions& options,
                                      const Run& run) {
  const FringeComparison set{optics, options.tolerance, options.max_samples};
  ResolveByViewsResult result;
  std::vector<RegionCandidates> cases;
  for (const UnresolvedViewRegion& part : unresolved) {
    result.removed_points += part.region.pixel.size();
    if (part.region.pixel.size() < options.min_region_px) continue;
    const FringePixels pixels{part.region.pixel, part.region.phase_rad};
    cases.push_back(
        {&part, fringe_order_candidates(pixels, views.rig_from_object(part.view), set)});
  }
  while (const std::size_t resolved = one_pass(views, cases, set, options, run)) {
    result.resolved_points += resolved;
    result.removed_points -= resolved;
  }
  return result;
}

}  // namespace frangia
