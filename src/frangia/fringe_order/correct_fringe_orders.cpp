#include "frangia/fringe_order/correct_fringe_orders.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/range/triangulate.h"

namespace frangia {
namespace {

/// Least score of the corrected order of a patch that other views do not contradict because it lies
/// behind their surface.
constexpr double kMinAgreementHidden = 0.75;

/// Largest share of the compared points that agrees with the present order.
constexpr double kMaxCurrentAgreement = 0.1;

/// Number of patches across a view.
constexpr int kPatchesAcross = 32;

/// Side of the patches around corrected ones.
constexpr int kRefinedPatch_px = 3;

/// Least share of the points of a removed patch that violate free space.
constexpr double kMinViolations = 0.5;

/// Maximum number of passes over all views.
constexpr int kPasses = 2;

struct Patch {
  FringePixels pixels;
  std::vector<FringeOrderCandidate> candidates;
};

/// Divides the pixels of the view that have a phase and that `wanted` marks into squares of `side`
/// pixels.
std::vector<Patch> patches_of(const View& view,
                              int side,
                              std::size_t min_pixels,
                              const Image<std::uint8_t>& wanted) {
  const Image<float>& phase = view.range.phase_rad;
  const int across = (phase.width() + side - 1) / side;
  const int down = (phase.height() + side - 1) / side;
  std::vector<Patch> grid(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  for (int y = 0; y < phase.height(); ++y) {
    for (int x = 0; x < phase.width(); ++x) {
      if (std::isnan(phase(x, y)) || wanted(x, y) == 0) continue;
      const int square = y / side * across + x / side;
      FringePixels& pixels = grid[static_cast<std::size_t>(square)].pixels;
      pixels.pixel.push_back(static_cast<std::uint32_t>(y * phase.width() + x));
      pixels.phase_rad.push_back(phase(x, y));
    }
  }
  std::vector<Patch> patches;
  for (Patch& patch : grid) {
    if (patch.pixels.pixel.size() >= min_pixels) patches.push_back(std::move(patch));
  }
  return patches;
}

/// Compares the candidates of all patches with every other view.
void compare_with_others(const ViewStore& views,
                         std::size_t own,
                         const FringeComparison& comparison,
                         std::vector<Patch>& patches) {
  parallel_chunks(patches.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      patches[i].candidates =
          fringe_order_candidates(patches[i].pixels, views.rig_from_object(own), comparison);
  });
  for (std::size_t other = 0; other < views.size(); ++other) {
    if (other == own) continue;
    const Image<float> depth_mm = views.load_depth_mm(other);
    parallel_chunks(patches.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (FringeOrderCandidate& candidate : patches[i].candidates)
          compare_with(depth_mm, views.rig_from_object(other), comparison, candidate);
      }
    });
  }
}

/// The correction of a patch's fringe order; 0 unless the other views determine it uniquely.
int order_correction(const Patch& patch, const FringeOrderCorrectionOptions& options) {
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
  if (current->agree > kMaxCurrentAgreement * points) return 0;
  // A patch that other views see through is certainly wrong, and the lower agreement suffices. A
  // patch hidden behind their surface is not contradicted and needs the higher one.
  const bool contradicted = current->violations + current->unseen >= points;
  const double wanted = contradicted ? options.min_agreement : kMinAgreementHidden;
  if (best->score() < wanted * points || second > options.max_runner_up * best->score()) return 0;
  return best->order;
}

/// Whether the patch violates the free space of other views and no view confirms it.
bool violates_free_space(const Patch& patch) {
  for (const FringeOrderCandidate& candidate : patch.candidates) {
    if (candidate.order != 0) continue;
    const auto points = static_cast<double>(candidate.points_mm.size());
    return candidate.agree <= kMaxCurrentAgreement * points &&
           candidate.violations >= kMinViolations * points;
  }
  return false;
}

/// Adds fringes to the phase of a pixel and triangulates it again.
void correct_pixel(const FringeComparison& comparison,
                   std::uint32_t index,
                   int fringes,
                   View& view) {
  const int x = static_cast<int>(index) % view.range.phase_rad.width();
  const int y = static_cast<int>(index) / view.range.phase_rad.width();
  const Eigen::Vector2d ray = comparison.rays(x, y).cast<double>();
  RangePixel pixel = view.range.pixel(x, y);
  const auto intersect = [&] {
    return intersect_fringe(ray, pixel.phase_rad, comparison.pattern, comparison.rig.projector);
  };
  const RayDepth before = intersect();
  pixel.phase_rad = static_cast<float>(pixel.phase_rad + kTwoPi * fringes);
  const RayDepth after = intersect();
  if (std::isnan(after.depth_mm)) return view.range.remove(x, y);
  pixel.depth_mm = static_cast<float>(after.depth_mm);
  const auto scale = static_cast<float>(std::abs(after.mm_per_rad / before.mm_per_rad));
  pixel.sigma_mm *= scale;
  pixel.systematic_mm *= scale;
  view.range.set(pixel);
}

/// Corrects the patches whose order is wrong; returns their pixels.
std::vector<std::uint32_t> correct_patches(const std::vector<Patch>& patches,
                                           const FringeComparison& comparison,
                                           const FringeOrderCorrectionOptions& options,
                                           View& view) {
  std::vector<std::uint32_t> corrected;
  for (const Patch& patch : patches) {
    const int fringes = order_correction(patch, options);
    if (fringes == 0) continue;
    const std::vector<std::uint32_t>& pixels = patch.pixels.pixel;
    for (const std::uint32_t pixel : pixels)
      correct_pixel(comparison, pixel, fringes, view);
    corrected.insert(corrected.end(), pixels.begin(), pixels.end());
  }
  return corrected;
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
                         const FringeComparison& comparison,
                         const FringeOrderCorrectionOptions& options) {
  View view = views.load(own);
  if (view.range.phase_rad.empty()) return 0;
  const int width = view.range.phase_rad.width();
  const int height = view.range.phase_rad.height();
  const int side = std::max(kRefinedPatch_px + 1, width / kPatchesAcross);
  const Image<std::uint8_t> everywhere(width, height, 1);
  auto patches = patches_of(view, side, options.min_patch_px, everywhere);
  compare_with_others(views, own, comparison, patches);
  const auto corrected = correct_patches(patches, comparison, options, view);
  if (corrected.empty()) return 0;
  // Patches around the corrected ones hold pixels of both orders: repeat with smaller patches.
  const auto border = around(corrected, width, height, side);
  auto refined = patches_of(view, kRefinedPatch_px, options.min_patch_px, border);
  compare_with_others(views, own, comparison, refined);
  const auto corrected_too = correct_patches(refined, comparison, options, view);
  for (const Patch& patch : refined) {
    if (order_correction(patch, options) != 0 || !violates_free_space(patch)) continue;
    for (const std::uint32_t pixel : patch.pixels.pixel)
      view.range.remove(static_cast<int>(pixel) % width, static_cast<int>(pixel) / width);
  }
  Image<PixelStatus> status(width, height, PixelStatus::Measured);
  remove_mixed_pixels(view.range, comparison.rays, status, options.mixed_pixels);
  view.edge_pixels.clear();  // the surface that they continued may have moved
  views.replace(own, view);
  return corrected.size() + corrected_too.size();
}

}  // namespace

std::size_t correct_fringe_orders(ViewStore& views,
                                  const FringeOptics& optics,
                                  const FringeOrderCorrectionOptions& options,
                                  const Run& run) {
  const FringeComparison comparison{optics, options.tolerance, options.max_samples};
  std::size_t corrected = 0;
  // Each view is compared with already corrected ones; the second pass does so for the first views.
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::size_t before = corrected;
    for (std::size_t own = 0; own < views.size(); ++own) {
      run.check();
      corrected += correct_view(views, own, comparison, options);
    }
    if (corrected == before) break;
  }
  return corrected;
}

}  // namespace frangia
