#include "frangia/views/anchor_by_views.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

struct Case {
  const LoosePart* part = nullptr;
  std::vector<FringeCandidate> candidates;
  bool settled = false;
};

/// The fringe that the other views confirm and no other rivals, or null.
const FringeCandidate* winner(const Case& one, const AnchorByViewsOptions& options) {
  const FringeCandidate* best = nullptr;
  const FringeCandidate* second = nullptr;
  for (const FringeCandidate& candidate : one.candidates) {
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
  const bool rivalled =
      second != nullptr && second->score() > options.max_runner_up * best->score();
  return rivalled ? nullptr : best;
}

void add_to_view(const LoosePart& part, int fringes, const FringeSetting& set, ViewStore& views) {
  View view = views.load(part.view);
  for (std::size_t i = 0; i < part.region.pixel.size(); ++i) {
    const std::uint32_t pixel = part.region.pixel[i];
    const Eigen::Vector2d ray = set.rays.pixels()[pixel].cast<double>();
    const double phase = part.region.phase_rad[i] + kTurn * fringes;
    const RayDepth found = intersect(ray, phase, set.pattern, set.rig.projector);
    if (std::isnan(found.depth_mm)) continue;
    view.range.depth_mm.pixels()[pixel] = static_cast<float>(found.depth_mm);
    view.range.sigma_mm.pixels()[pixel] = static_cast<float>(
        std::abs(found.mm_per_rad) * part.region.sigma_rad[i] * std::sqrt(1.0 + ray.squaredNorm()));
  }
  views.replace(part.view, view);
}

/// One look at every view; returns the points anchored.
std::size_t one_round(ViewStore& views,
                      std::vector<Case>& cases,
                      const FringeSetting& set,
                      const AnchorByViewsOptions& options,
                      const Run& run) {
  for (Case& one : cases) {
    for (FringeCandidate& candidate : one.candidates)
      candidate.agree = candidate.contradict = candidate.unseen = 0;
  }
  for (std::size_t other = 0; other < views.size(); ++other) {
    run.check();
    const View view = views.load(other);
    parallel_chunks(cases.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (cases[i].settled || cases[i].part->view == other) continue;
        for (FringeCandidate& candidate : cases[i].candidates)
          compare_with(view, set, candidate);
      }
    });
  }
  std::size_t anchored = 0;
  for (Case& one : cases) {
    const FringeCandidate* best = one.settled ? nullptr : winner(one, options);
    if (best == nullptr) continue;
    add_to_view(*one.part, best->fringes, set, views);
    one.settled = true;
    anchored += one.part->region.pixel.size();
  }
  return anchored;
}

}  // namespace

AnchorByViewsResult anchor_by_views(ViewStore& views,
                                    const std::vector<LoosePart>& loose,
                                    const FringeOptics& optics,
                                    const AnchorByViewsOptions& options,
                                    const Run& run) {
  const FringeSetting set{optics, options.tolerance, options.max_samples};
  AnchorByViewsResult result;
  std::vector<Case> cases;
  for (const LoosePart& part : loose) {
    result.dropped_points += part.region.pixel.size();
    if (part.region.pixel.size() < options.min_region_px) continue;
    const FringePixels pixels{part.region.pixel, part.region.phase_rad};
    cases.push_back({&part, fringe_candidates(pixels, views.rig_from_object(part.view), set)});
  }
  while (const std::size_t anchored = one_round(views, cases, set, options, run)) {
    result.anchored_points += anchored;
    result.dropped_points -= anchored;
  }
  return result;
}

}  // namespace frangia
