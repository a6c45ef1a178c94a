#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/internal/fringe_forest.h"
#include "frangia/phase/spatial/internal/unwrap_pixels.h"
#include "frangia/phase/spatial/internal/unwrap_run_merging.h"

namespace frangia {
namespace {

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

}  // namespace

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

}  // namespace frangia
