#include "frangia/phase/spatial/unwrap_spatially.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/internal/fringe_forest.h"
#include "frangia/phase/spatial/internal/cut_mask.h"
#include "frangia/phase/spatial/internal/unwrap_run_merging.h"
#include "frangia/phase/spatial/split_regions.h"

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

/// Unwraps each region by growth from its best pixel to the neighbour with the largest product of
/// modulations. The best pixel has fringe order 0. With `keep_growth_order` the order of growth is
/// recorded.
///
/// @source   the paper's reference [35], Takeda & Abe 1996
RelativePhase unwrap_quality_guided(const WrappedPhase& phase,
                                    const Regions& regions,
                                    bool keep_growth_order = false) {
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

float wrapped(float jump) {
  return jump - kTwoPiF * std::round(jump / kTwoPiF);
}

/// Sum of squared second differences along rows, columns and both diagonals; infinite where a
/// neighbour is missing.
Image<float> second_differences_of(const Image<float>& phase) {
  Image<float> second_difference(
      phase.width(), phase.height(), std::numeric_limits<float>::infinity());
  parallel_rows(phase.height(), [&](int y) {
    if (y == 0 || y + 1 == phase.height()) return;
    for (int x = 1; x + 1 < phase.width(); ++x) {
      const float here = phase(x, y);
      const auto along = [&](int dx, int dy) {
        const float difference =
            wrapped(phase(x - dx, y - dy) - here) - wrapped(here - phase(x + dx, y + dy));
        return difference * difference;
      };
      const float sum = along(1, 0) + along(0, 1) + along(1, 1) + along(1, -1);
      if (!std::isnan(sum)) second_difference(x, y) = sum;
    }
  });
  return second_difference;
}

struct Edge {
  float second_difference;
  std::uint32_t from;
  std::uint32_t to;
};

/// Smooth edges within regions, the most reliable first; ties in raster order.
std::vector<Edge> sorted_edges(const Image<float>& phase, const Regions& regions) {
  const Image<float> second_difference = second_differences_of(phase);
  const auto width = static_cast<std::uint32_t>(phase.width());
  const auto label = regions.label.pixels();
  std::vector<Edge> edges;
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    if (label[from] < 0 || label[from] != label[to]) return;
    edges.push_back({second_difference.pixels()[from] + second_difference.pixels()[to], from, to});
  };
  for (int y = 0; y < phase.height(); ++y) {
    for (int x = 0; x < phase.width(); ++x) {
      const auto i = static_cast<std::uint32_t>(y) * width + static_cast<std::uint32_t>(x);
      if (x + 1 < phase.width() && regions.smooth_right(x, y) != 0) add(i, i + 1);
      if (y + 1 < phase.height() && regions.smooth_below(x, y) != 0) add(i, i + width);
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.second_difference < b.second_difference;
  });
  return edges;
}

/// Unwraps each region by joining pixels along their edges, the most reliable first: those with the
/// smallest second differences. The best pixel of a region has fringe order 0.
///
/// @source   Herráez, Burton, Lalor and Gdeisat 2002
RelativePhase unwrap_reliability_sorted(const WrappedPhase& phase, const Regions& regions) {
  const auto rad = phase.phase_rad.pixels();
  FringeForest forest(rad.size());  // of pixels
  for (const Edge& edge : sorted_edges(phase.phase_rad, regions)) {
    const auto turns =
        static_cast<std::int32_t>(std::lround((rad[edge.from] - rad[edge.to]) / kTwoPiF));
    forest.join(edge.from, edge.to, turns);
  }
  const auto best = best_pixels(phase.modulation_counts, regions.label, regions.count);
  RelativePhase out{.pattern = phase.pattern,
                    .phase_rad = phase.phase_rad,
                    .sigma_rad = phase.sigma_rad,
                    .region = regions.label,
                    .region_count = regions.count,
                    .status = phase.status,
                    .growth_order = {},
                    .systematic_rad = phase.systematic_rad};
  const auto labels = regions.label.pixels();
  for (std::size_t i = 0; i < rad.size(); ++i) {
    if (labels[i] < 0) continue;
    const std::int32_t zero = forest.root(best[static_cast<std::size_t>(labels[i])]).fringes;
    out.phase_rad.pixels()[i] += kTwoPiF * static_cast<float>(forest.root(i).fringes - zero);
  }
  return out;
}

}  // namespace

RelativePhase unwrap_spatially(WrappedPhase phase, const SpatialUnwrapOptions& options) {
  discard_residues(phase);
  Regions regions = split_regions(phase, options.split);
  RelativePhase relative;
  Image<std::int32_t> order;
  if (options.keep_growth_order) order = unwrap_quality_guided(phase, regions, true).growth_order;
  switch (options.method) {
    case SpatialMethod::RunMerging:
      relative = unwrap_run_merging(std::move(phase), regions);
      break;
    case SpatialMethod::QualityGuided:
      relative = unwrap_quality_guided(phase, regions);
      break;
    case SpatialMethod::ReliabilitySorted:
      relative = unwrap_reliability_sorted(phase, regions);
      break;
  }
  relative.growth_order = std::move(order);
  join_regions(relative, regions, options.join);
  return relative;
}

}  // namespace frangia
