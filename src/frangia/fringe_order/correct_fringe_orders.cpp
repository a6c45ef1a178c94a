#include "frangia/fringe_order/correct_fringe_orders.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/range/remove_mixed_pixels.h"

namespace frangia {
namespace {

constexpr int kSamples = 48;
constexpr std::size_t kFewestPixels = 4;

struct Patch {
  FringePixels pixels;
  std::vector<FringeOrderCandidate> candidates;
};

Eigen::Vector3d point_at(const View& view, const Image<Eigen::Vector2f>& rays, std::size_t pixel) {
  const Eigen::Vector2d ray = rays.pixels()[pixel].cast<double>();
  const double depth = view.range.depth_mm.pixels()[pixel];
  return depth * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
}

/// Divides the measured pixels of the view that `wanted` marks into squares of `side` pixels.
std::vector<Patch> patches_of(const View& view,
                              const FringeComparison& set,
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

/// Compares the candidates of all patches with every other view.
void compare_with_others(const ViewStore& views,
                         std::size_t own,
                         const FringeComparison& set,
                         std::vector<Patch>& patches) {
  parallel_chunks(patches.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      patches[i].candidates =
          fringe_order_candidates(patches[i].pixels, views.rig_from_object(own), set);
  });
  for (std::size_t other = 0; other < views.size(); ++other) {
    if (other == own) continue;
    const View view = views.load(other);
    parallel_chunks(patches.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (FringeOrderCandidate& candidate : patches[i].candidates)
          compare_with(view, set, candidate);
      }
    });
  }
}

/// The correction of a patch's fringe order; 0 unless the other views determine it uniquely.
int order_error(const Patch& patch, const FringeOrderCorrectionOptions& options) {
  const FringeOrderCandidate* current = nullptr;
  const FringeOrderCandidate* best = nullptr;
  int second = 0;
  for (const FringeOrderCandidate& candidate : patch.candidates) {
    if (candidate.order == 0) {
      current = &candidate;
    } else if (best == nullptr || candidate.score() > best->score()) {
      if (best != nullptr) second = std::max(second, best->score());
      best = &candidate;
    } else {
      second = std::max(second, candidate.score());
    }
  }
  if (current == nullptr || best == nullptr) return 0;
  const auto points = static_cast<double>(best->points_mm.size());
  if (current->agree > options.max_current_agreement * points) return 0;
  // A patch that other views see through is certainly wrong, and the lower agreement suffices. A
  // patch hidden behind their surface is not contradicted and needs the higher one.
  const bool missed = current->violations + current->unseen >= points;
  const double wanted = missed ? options.min_agreement : options.min_agreement_hidden;
  if (best->score() < wanted * points || 2 * second > best->score()) return 0;
  return best->order;
}

/// Whether the patch violates the free space of other views and no view confirms it.
bool violates_free_space(const Patch& patch, const FringeOrderCorrectionOptions& options) {
  for (const FringeOrderCandidate& candidate : patch.candidates) {
    if (candidate.order != 0) continue;
    const auto points = static_cast<double>(candidate.points_mm.size());
    return candidate.agree <= options.max_current_agreement * points &&
           2 * candidate.violations >= points;
  }
  return false;
}

void correct_pixel(const FringeComparison& set, std::size_t pixel, double phase_rad, View& view) {
  const Eigen::Vector2d ray = set.rays.pixels()[pixel].cast<double>();
  float& depth = view.range.depth_mm.pixels()[pixel];
  float& sigma = view.range.sigma_mm.pixels()[pixel];
  const RayDepth before =
      intersect_fringe(ray,
                       phase_at(point_at(view, set.rays, pixel), set.pattern, set.rig.projector),
                       set.pattern,
                       set.rig.projector);
  const RayDepth after = intersect_fringe(ray, phase_rad, set.pattern, set.rig.projector);
  depth = static_cast<float>(after.depth_mm);
  sigma *= static_cast<float>(std::abs(after.mm_per_rad / before.mm_per_rad));
}

/// Corrects the patches whose order is wrong; returns their pixels.
std::vector<std::uint32_t> correct_patches(const std::vector<Patch>& patches,
                                           const FringeComparison& set,
                                           const FringeOrderCorrectionOptions& options,
                                           View& view) {
  std::vector<std::uint32_t> moved;
  for (const Patch& patch : patches) {
    const int off = order_error(patch, options);
    if (off == 0) continue;
    const FringePixels& pixels = patch.pixels;
    for (std::size_t i = 0; i < pixels.pixel.size(); ++i)
      correct_pixel(set, pixels.pixel[i], pixels.phase_rad[i] + kTwoPi * off, view);
    moved.insert(moved.end(), pixels.pixel.begin(), pixels.pixel.end());
  }
  return moved;
}

/// Marks the given pixels and their eight neighbours at distance `reach`.
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

std::size_t correct_view(ViewStore& views,
                         std::size_t own,
                         const FringeComparison& set,
                         const FringeOrderCorrectionOptions& options) {
  View view = views.load(own);
  const int width = view.range.depth_mm.width();
  const int height = view.range.depth_mm.height();
  const int side = std::max(4, width / options.patches_across);
  auto patches = patches_of(view, set, side, Image<std::uint8_t>(width, height, 1));
  compare_with_others(views, own, set, patches);
  const auto moved = correct_patches(patches, set, options, view);
  if (moved.empty()) return 0;
  // Patches around the corrected ones hold pixels of both orders: repeat with 3 x 3 pixels.
  views.replace(own, view);
  auto small = patches_of(view, set, 3, around(moved, width, height, side));
  compare_with_others(views, own, set, small);
  const auto moved_too = correct_patches(small, set, options, view);
  for (const Patch& patch : small) {
    if (order_error(patch, options) != 0 || !violates_free_space(patch, options)) continue;
    for (const std::uint32_t pixel : patch.pixels.pixel)
      view.range.depth_mm.pixels()[pixel] = view.range.sigma_mm.pixels()[pixel] = kMissing;
  }
  Image<PixelStatus> status(width, height, PixelStatus::Measured);
  remove_mixed_pixels(view.range, set.rays, status);
  view.edge_pixels.clear();  // the surface that they continued may have moved
  views.replace(own, view);
  return moved.size() + moved_too.size();
}

}  // namespace

std::size_t correct_fringe_orders(ViewStore& views,
                                  const FringeOptics& optics,
                                  const FringeOrderCorrectionOptions& options,
                                  const Run& run) {
  const FringeComparison set{optics, options.tolerance, kSamples};
  std::size_t moved = 0;
  // Each view is compared with already corrected ones; the second pass does so for the first views.
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t before = moved;
    for (std::size_t own = 0; own < views.size(); ++own) {
      run.check();
      moved += correct_view(views, own, set, options);
    }
    if (moved == before) break;
  }
  return moved;
}

}  // namespace frangia
