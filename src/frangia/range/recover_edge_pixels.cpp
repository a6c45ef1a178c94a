#include "frangia/range/recover_edge_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/four_neighbors.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/internal/continues_surface.h"
#include "frangia/range/internal/is_depth_step.h"

namespace frangia {
namespace {

enum EdgePixelState : std::uint8_t { Removed, Recovered, BehindStep };
using EdgePixelStates = std::vector<std::uint8_t>;

/// Recovers the pixels that continue the surface in the grid, and adds them to it.
void recover_supported(RangeGrid& grid,
                       const ReliablePixels& reliable,
                       const std::vector<RangePixel>& removed,
                       EdgePixelStates& states) {
  parallel_chunks(removed.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (states[i] == Removed && continues_surface(reliable, removed[i])) states[i] = Recovered;
    }
  });
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (states[i] == Recovered) grid.set(removed[i]);
  }
}

/// Whether a pixel lies behind its neighbour at `step` across a depth step, see `is_depth_step`.
bool is_behind(const ReliablePixels& seen,
               const EdgePixelOptions& options,
               const Eigen::Vector2i& at,
               const Eigen::Vector2i& step) {
  const auto& depth = seen.range.depth_mm;
  const auto depth_at = [&](int k) {
    const Eigen::Vector2i p = at + k * step;
    const bool inside = p.minCoeff() >= 0 && p.x() < depth.width() && p.y() < depth.height();
    return inside ? depth(p.x(), p.y()) : kMissing;
  };
  const float jump = depth_at(0) - depth_at(1);
  if (!(jump > 0.0F)) return false;
  const Eigen::Vector2i next = at + step;
  const float pixel_mm =
      (seen.rays(at.x(), at.y()) - seen.rays(next.x(), next.y())).norm() * depth_at(0);
  const float noise = seen.range.sigma_mm(at.x(), at.y());
  return is_depth_step({jump, depth_at(-1) - depth_at(0), depth_at(1) - depth_at(2)},
                       static_cast<float>(options.min_step_px) * pixel_mm +
                           static_cast<float>(options.min_step_sigmas) * noise);
}

bool is_behind_step(const ReliablePixels& seen,
                    const EdgePixelOptions& options,
                    const RangePixel& pixel) {
  const Eigen::Vector2i at(pixel.x, pixel.y);
  return std::any_of(kFourNeighbors.begin(), kFourNeighbors.end(), [&](const auto& step) {
    return is_behind(seen, options, at, {step[0], step[1]});
  });
}

}  // namespace

std::vector<RangePixel> recover_edge_pixels(const RangeGrid& reliable,
                                            const Image<Eigen::Vector2f>& rays,
                                            const std::vector<RangePixel>& removed,
                                            const EdgePixelOptions& options) {
  require(same_size(reliable.depth_mm, rays), "recover_edge_pixels: range and rays differ in size");
  RangeGrid grid{reliable.depth_mm, reliable.sigma_mm};
  const auto slope = static_cast<float>(std::tan(rad_from_deg(options.max_incidence_deg)));
  const ReliablePixels seen{grid, rays, slope};
  EdgePixelStates states(removed.size(), Removed);
  for (int ring = 0; ring < options.depth_px; ++ring)
    recover_supported(grid, seen, removed, states);
  parallel_chunks(removed.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (states[i] == Recovered && is_behind_step(seen, options, removed[i]))
        states[i] = BehindStep;
    }
  });
  std::vector<RangePixel> edge_pixels;
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (states[i] == Recovered) edge_pixels.push_back(removed[i]);
  }
  return edge_pixels;
}

}  // namespace frangia
