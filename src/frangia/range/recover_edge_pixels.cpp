#include "frangia/range/recover_edge_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/four_neighbors.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/pixel_box.h"
#include "frangia/range/internal/continues_surface.h"
#include "frangia/range/internal/is_depth_step.h"

namespace frangia {
namespace {

/// Pixels around a removed one that its recovery reads: at most five, see `continues_surface`.
constexpr int kMargin = 8;

/// Copies the part of an image in a box; the other pixels stay uninitialized.
Image<float> copy_of(const Image<float>& image, const PixelBox& box) {
  Image<float> copy(image.width(), image.height(), Uninitialized{});
  for (int y = box.top; y < box.bottom; ++y)
    std::copy_n(&image(box.left, y), box.width(), &copy(box.left, y));
  return copy;
}

/// The box that holds pixels.
PixelBox box_of(const std::vector<RangePixel>& pixels) {
  PixelBox box{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0, 0};
  for (const RangePixel& pixel : pixels) {
    box.left = std::min(box.left, pixel.x);
    box.top = std::min(box.top, pixel.y);
    box.right = std::max(box.right, pixel.x + 1);
    box.bottom = std::max(box.bottom, pixel.y + 1);
  }
  return box;
}

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
  const PixelBox box = grow(box_of(removed), kMargin, rays.width(), rays.height());
  RangeGrid grid{copy_of(reliable.depth_mm, box), copy_of(reliable.sigma_mm, box)};
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
