#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/phase/spatial/internal/unwrap_pixels.h"
#include "frangia/phase/spatial/internal/unwrap_run_merging.h"

namespace frangia {
namespace {

/// Number of quality levels: enough to preserve the order of growth, few enough to stay in the
/// cache.
constexpr std::size_t kLevels = 256;

/// A priority queue of pixels by quality level.
class Frontier {
 public:
  void push(std::size_t level, std::uint32_t pixel) {
    buckets_[level].push_back(pixel);
    best_ = std::max(best_, level);
  }
  /// Returns false when the queue is empty.
  bool pop(std::uint32_t& pixel) {
    while (buckets_[best_].empty()) {
      if (best_ == 0) return false;
      --best_;
    }
    pixel = buckets_[best_].back();
    buckets_[best_].pop_back();
    return true;
  }

 private:
  std::array<std::vector<std::uint32_t>, kLevels> buckets_;
  std::size_t best_ = 0;
};

/// Replaces each unwrapped phase by its wrapped phase plus whole turns, which removes rounding
/// errors that accumulate along the path.
void snap_to_whole_fringes(std::span<const float> wrapped, std::span<float> unwrapped) {
  for (std::size_t i = 0; i < unwrapped.size(); ++i) {
    if (std::isnan(unwrapped[i])) continue;
    const double orders = std::round((static_cast<double>(unwrapped[i]) - wrapped[i]) / kTwoPi);
    unwrapped[i] = static_cast<float>(wrapped[i] + kTwoPi * orders);
  }
}

}  // namespace

RelativePhase unwrap_quality_guided(const WrappedPhase& phase,
                                    const Regions& regions,
                                    bool keep_growth_order) {
  const int width = phase.phase_rad.width();
  const int height = phase.phase_rad.height();
  const auto row = static_cast<std::size_t>(width);
  RelativePhase out{.pattern = phase.pattern,
                    .phase_rad = Image<float>(width, height, kMissing),
                    .sigma_rad = phase.sigma_rad,
                    .region = regions.label,
                    .region_count = regions.count,
                    .status = phase.status,
                    .growth_order = {},
                    .systematic_rad = phase.systematic_rad};
  if (keep_growth_order) out.growth_order = Image<std::int32_t>(width, height, -1);
  std::int32_t reached = 0;
  const auto wrapped = phase.phase_rad.pixels();
  const auto modulation = phase.modulation_counts.pixels();
  const auto labels = regions.label.pixels();
  const auto unwrapped = out.phase_rad.pixels();
  const auto right = regions.smooth_right.pixels();
  const auto below = regions.smooth_below.pixels();
  const float max_modulation = *std::max_element(modulation.begin(), modulation.end());
  const float scale = max_modulation > 0.0F ? (kLevels - 1) / max_modulation : 0.0F;

  Frontier frontier;
  const auto reach = [&](std::size_t from, std::size_t to) {
    if (labels[to] != labels[from] || !std::isnan(unwrapped[to])) return;
    const float jump = wrapped[to] - wrapped[from];
    const float short_way = jump - kTwoPiF * std::round(jump / kTwoPiF);
    // Pixels are unwrapped when they are pushed, from the neighbour that reaches them first.
    unwrapped[to] = unwrapped[from] + short_way;
    if (keep_growth_order) out.growth_order.pixels()[to] = ++reached;
    const float product = std::sqrt(std::max(0.0F, modulation[from] * modulation[to]));
    frontier.push(static_cast<std::size_t>(product * scale), static_cast<std::uint32_t>(to));
  };
  for (const std::uint32_t seed :
       best_pixels(phase.modulation_counts, regions.label, regions.count)) {
    unwrapped[seed] = wrapped[seed];
    reached = 0;
    if (keep_growth_order) out.growth_order.pixels()[seed] = reached;
    std::uint32_t pixel = seed;
    do {
      const std::size_t i = pixel;
      const std::size_t x = i % row;
      const std::size_t y = i / row;
      if (x > 0 && right[i - 1] != 0) reach(i, i - 1);
      if (x + 1 < row && right[i] != 0) reach(i, i + 1);
      if (y > 0 && below[i - row] != 0) reach(i, i - row);
      if (y + 1 < static_cast<std::size_t>(height) && below[i] != 0) reach(i, i + row);
    } while (frontier.pop(pixel));
  }
  snap_to_whole_fringes(wrapped, unwrapped);
  return out;
}

}  // namespace frangia
