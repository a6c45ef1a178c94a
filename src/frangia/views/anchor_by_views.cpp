#include "frangia/views/anchor_by_views.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

/// One whole number of fringes that a region may have, and what the other views say of it.
struct Candidate {
  int fringes = 0;
  std::vector<Eigen::Vector3d> points_mm;  ///< object frame
  double spacing_mm = 0.0;                 ///< depth from here to the next fringe
  int agree = 0;
  int contradict = 0;

  [[nodiscard]] int score() const { return agree - 2 * contradict; }
};

struct Case {
  const LoosePart* part = nullptr;
  std::vector<Candidate> candidates;
  bool settled = false;
};

struct Setting {
  const Pattern& pattern;
  const Rig& rig;
  const Image<Eigen::Vector2f>& rays;
  const AnchorByViewsOptions& options;
};

Eigen::Vector3d point_on(const Eigen::Vector2f& ray, double depth_mm) {
  return depth_mm * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
}

Case candidates_of(const LoosePart& part, const Eigen::Isometry3d& pose, const Setting& set) {
  Case out{.part = &part, .candidates = {}};
  const auto [low, high] =
      std::minmax_element(part.region.phase_rad.begin(), part.region.phase_rad.end());
  const PhaseRange lit = phase_range(set.pattern, set.rig.projector);
  const int first = static_cast<int>(std::floor((lit.min_rad - *high) / kTurn));
  const int last = static_cast<int>(std::ceil((lit.max_rad - *low) / kTurn));
  const std::size_t stride = std::max<std::size_t>(
      1, part.region.pixel.size() / static_cast<std::size_t>(set.options.max_samples));
  const Eigen::Isometry3d object_from_rig = pose.inverse();
  for (int fringes = first; fringes <= last; ++fringes) {
    Candidate candidate{.fringes = fringes, .points_mm = {}};
    for (std::size_t i = 0; i < part.region.pixel.size(); i += stride) {
      const double phase = part.region.phase_rad[i] + kTurn * fringes;
      if (phase < lit.min_rad || phase > lit.max_rad) continue;
      const Eigen::Vector2f ray = set.rays.pixels()[part.region.pixel[i]];
      const RayDepth found = intersect(ray.cast<double>(), phase, set.pattern, set.rig.projector);
      if (std::isnan(found.depth_mm)) continue;
      candidate.points_mm.emplace_back(object_from_rig * point_on(ray, found.depth_mm));
      candidate.spacing_mm = std::abs(found.mm_per_rad) * kTurn;
    }
    const std::size_t wanted = part.region.pixel.size() / stride;
    if (2 * candidate.points_mm.size() > wanted) out.candidates.push_back(std::move(candidate));
  }
  return out;
}

void compare(const View& view, const Setting& set, Candidate& candidate) {
  const auto& depth = view.range.depth_mm;
  const double tolerance = set.options.tolerance * candidate.spacing_mm;
  for (const Eigen::Vector3d& point : candidate.points_mm) {
    const Eigen::Vector3d seen = view.rig_from_object * point;
    if (!(seen.z() > 0.0)) continue;
    const Eigen::Vector2d pixel = set.rig.camera.lens.project(seen);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    if (x < 0 || y < 0 || x >= depth.width() || y >= depth.height()) continue;
    const double in_front = depth(x, y) - seen.z();
    if (std::abs(in_front) <= tolerance) ++candidate.agree;
    if (in_front > 2.0 * tolerance) ++candidate.contradict;  // that view sees through it
  }
}

/// The fringe that the other views confirm and no other rivals, or null.
const Candidate* winner(const Case& one, const AnchorByViewsOptions& options) {
  const Candidate* best = nullptr;
  const Candidate* second = nullptr;
  for (const Candidate& candidate : one.candidates) {
    if (best == nullptr || candidate.score() > best->score()) {
      second = best;
      best = &candidate;
    } else if (second == nullptr || candidate.score() > second->score()) {
      second = &candidate;
    }
  }
  if (best == nullptr) return nullptr;
  if (best->score() < options.min_agreement * static_cast<double>(best->points_mm.size()))
    return nullptr;
  const bool rivalled =
      second != nullptr && second->score() > options.max_runner_up * best->score();
  return rivalled ? nullptr : best;
}

void add_to_view(const LoosePart& part, int fringes, const Setting& set, ViewStore& views) {
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
                      const Setting& set,
                      const Run& run) {
  for (Case& one : cases) {
    for (Candidate& candidate : one.candidates)
      candidate.agree = candidate.contradict = 0;
  }
  for (std::size_t other = 0; other < views.size(); ++other) {
    run.check();
    const View view = views.load(other);
    parallel_chunks(cases.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (cases[i].settled || cases[i].part->view == other) continue;
        for (Candidate& candidate : cases[i].candidates)
          compare(view, set, candidate);
      }
    });
  }
  std::size_t anchored = 0;
  for (Case& one : cases) {
    const Candidate* best = one.settled ? nullptr : winner(one, set.options);
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
                                    const Pattern& pattern,
                                    const Rig& rig,
                                    const Image<Eigen::Vector2f>& rays,
                                    const AnchorByViewsOptions& options,
                                    const Run& run) {
  const Setting set{pattern, rig, rays, options};
  AnchorByViewsResult result;
  std::vector<Case> cases;
  for (const LoosePart& part : loose) {
    result.dropped_points += part.region.pixel.size();
    if (part.region.pixel.size() < options.min_region_px) continue;
    cases.push_back(candidates_of(part, views.rig_from_object(part.view), set));
  }
  while (const std::size_t anchored = one_round(views, cases, set, run)) {
    result.anchored_points += anchored;
    result.dropped_points -= anchored;
  }
  return result;
}

}  // namespace frangia
