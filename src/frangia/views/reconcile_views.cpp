#include "frangia/views/reconcile_views.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/drop_mixed_edges.h"
#include "frangia/range/fringe_ray.h"

namespace frangia {
namespace {

constexpr int kSamples = 48;
constexpr std::size_t kFewestPixels = 4;

struct Patch {
  FringePixels pixels;
  std::vector<FringeCandidate> candidates;
};

Eigen::Vector3d point_at(const View& view, const Image<Eigen::Vector2f>& rays, std::size_t pixel) {
  const Eigen::Vector2d ray = rays.pixels()[pixel].cast<double>();
  const double depth = view.range.depth_mm.pixels()[pixel];
  return depth * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
}

/// The measured pixels of the view in squares of `side`, for the squares that `wanted` holds.
std::vector<Patch> patches_of(const View& view,
                              const FringeSetting& set,
                              int side,
                              const Image<std::uint8_t>& wanted) {
  const auto& depth = view.range.depth_mm;
  const int across = (depth.width() + side - 1) / side;
  const int down = (depth.height() + side - 1) / side;
  std::vector<Patch> grid(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      if (std::isnan(depth(x, y)) || wanted(x, y) == 0) continue;
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(depth.width()) +
                         static_cast<std::size_t>(x);
      const int square = y / side * across + x / side;
      FringePixels& pixels = grid[static_cast<std::size_t>(square)].pixels;
      pixels.pixel.push_back(static_cast<std::uint32_t>(pixel));
      pixels.phase_rad.push_back(static_cast<float>(
          phase_at(point_at(view, set.rays, pixel), set.pattern, set.rig.projector)));
    }
  }
  std::vector<Patch> patches;
  for (Patch& patch : grid) {
    if (patch.pixels.pixel.size() >= kFewestPixels) patches.push_back(std::move(patch));
  }
  return patches;
}

/// Lets every other view say what it sees at each of the patches' candidates.
void ask_others(const ViewStore& views,
                std::size_t own,
                const FringeSetting& set,
                std::vector<Patch>& patches) {
  parallel_chunks(patches.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      patches[i].candidates = fringe_candidates(patches[i].pixels, views.rig_from_object(own), set);
  });
  for (std::size_t other = 0; other < views.size(); ++other) {
    if (other == own) continue;
    const View view = views.load(other);
    parallel_chunks(patches.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (FringeCandidate& candidate : patches[i].candidates)
          compare_with(view, set, candidate);
      }
    });
  }
}

/// The fringes by which the patch is off; 0 unless the others leave no doubt.
int fringes_off(const Patch& patch, const ReconcileOptions& options) {
  const FringeCandidate* present = nullptr;
  const FringeCandidate* best = nullptr;
  int second = 0;
  for (const FringeCandidate& candidate : patch.candidates) {
    if (candidate.fringes == 0) {
      present = &candidate;
    } else if (best == nullptr || candidate.score() > best->score()) {
      if (best != nullptr) second = std::max(second, best->score());
      best = &candidate;
    } else {
      second = std::max(second, candidate.score());
    }
  }
  if (present == nullptr || best == nullptr) return 0;
  const auto points = static_cast<double>(best->points_mm.size());
  if (present->agree > options.max_present * points) return 0;
  // Where others look at it and do not find it, half of it elsewhere is enough; where it hides from
  // them behind the surface, most of it must be that surface.
  const bool missed = present->contradict + present->unseen >= points;
  const double wanted = missed ? options.min_agreement : options.min_agreement_hidden;
  if (best->score() < wanted * points || 2 * second > best->score()) return 0;
  return best->fringes;
}

/// Whether others see through the patch and none confirms it.
bool is_refuted(const Patch& patch, const ReconcileOptions& options) {
  for (const FringeCandidate& candidate : patch.candidates) {
    if (candidate.fringes != 0) continue;
    const auto points = static_cast<double>(candidate.points_mm.size());
    return candidate.agree <= options.max_present * points && 2 * candidate.contradict >= points;
  }
  return false;
}

void move_pixel(const FringeSetting& set, std::size_t pixel, double phase_rad, View& view) {
  const Eigen::Vector2d ray = set.rays.pixels()[pixel].cast<double>();
  float& depth = view.range.depth_mm.pixels()[pixel];
  float& sigma = view.range.sigma_mm.pixels()[pixel];
  const RayDepth before =
      intersect(ray,
                phase_at(point_at(view, set.rays, pixel), set.pattern, set.rig.projector),
                set.pattern,
                set.rig.projector);
  const RayDepth after = intersect(ray, phase_rad, set.pattern, set.rig.projector);
  depth = static_cast<float>(after.depth_mm);
  sigma *= static_cast<float>(std::abs(after.mm_per_rad / before.mm_per_rad));
}

/// Moves the patches that are off; returns their pixels.
std::vector<std::uint32_t> move_patches(const std::vector<Patch>& patches,
                                        const FringeSetting& set,
                                        const ReconcileOptions& options,
                                        View& view) {
  std::vector<std::uint32_t> moved;
  for (const Patch& patch : patches) {
    const int off = fringes_off(patch, options);
    if (off == 0) continue;
    const FringePixels& pixels = patch.pixels;
    for (std::size_t i = 0; i < pixels.pixel.size(); ++i)
      move_pixel(set, pixels.pixel[i], pixels.phase_rad[i] + kTurn * off, view);
    moved.insert(moved.end(), pixels.pixel.begin(), pixels.pixel.end());
  }
  return moved;
}

/// Marks the pixels and, in steps of `reach`, those so far to each side of them.
Image<std::uint8_t> around(const std::vector<std::uint32_t>& pixels,
                           int width,
                           int height,
                           int reach) {
  Image<std::uint8_t> near(width, height, 0);
  for (const std::uint32_t pixel : pixels) {
    const int x = static_cast<int>(pixel) % width;
    const int y = static_cast<int>(pixel) / width;
    for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); v += reach) {
      for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); u += reach)
        near(u, v) = 1;
    }
  }
  return near;
}

std::size_t reconcile_view(ViewStore& views,
                           std::size_t own,
                           const FringeSetting& set,
                           const ReconcileOptions& options) {
  View view = views.load(own);
  const int width = view.range.depth_mm.width();
  const int height = view.range.depth_mm.height();
  const int side = std::max(4, width / options.patches_across);
  auto patches = patches_of(view, set, side, Image<std::uint8_t>(width, height, 1));
  ask_others(views, own, set, patches);
  const auto moved = move_patches(patches, set, options, view);
  if (moved.empty()) return 0;
  // Around what moved, squares hold pixels of both kinds: again, in squares of three pixels.
  views.replace(own, view);
  auto small = patches_of(view, set, 3, around(moved, width, height, side));
  ask_others(views, own, set, small);
  const auto moved_too = move_patches(small, set, options, view);
  for (const Patch& patch : small) {
    if (fringes_off(patch, options) != 0 || !is_refuted(patch, options)) continue;
    for (const std::uint32_t pixel : patch.pixels.pixel)
      view.range.depth_mm.pixels()[pixel] = view.range.sigma_mm.pixels()[pixel] = kMissing;
  }
  Image<PixelFate> fate(width, height, PixelFate::Measured);
  drop_mixed_edges(view.range, set.rays, fate);
  view.rim.clear();  // what it hung on may be elsewhere
  views.replace(own, view);
  return moved.size() + moved_too.size();
}

}  // namespace

std::size_t reconcile_views(ViewStore& views,
                            const FringeOptics& optics,
                            const ReconcileOptions& options,
                            const Run& run) {
  const FringeSetting set{optics, options.tolerance, kSamples};
  std::size_t moved = 0;
  // What one view puts right helps to judge the next; a second round judges the first views so too.
  for (int round = 0; round < 2; ++round) {
    const std::size_t before = moved;
    for (std::size_t own = 0; own < views.size(); ++own) {
      run.check();
      moved += reconcile_view(views, own, set, options);
    }
    if (moved == before) break;
  }
  return moved;
}

}  // namespace frangia
