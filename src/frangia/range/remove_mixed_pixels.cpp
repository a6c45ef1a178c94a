#include "frangia/range/remove_mixed_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/internal/pixel_connections.h"
#include "frangia/range/measured_volume.h"

namespace frangia {
namespace {

struct Grid {
  const RangeGrid& range;
  const Image<Eigen::Vector2f>& rays;
  PixelBox box;  ///< holds all measured pixels
};

/// How many pixels beside the border of a surface receive more light from beyond it than
/// `light_sigmas` of a normal blur leave there; the first pixel has its centre at half a pixel.
int mixed_reach_px(double blur_px, double light_sigmas) {
  return std::max(1, static_cast<int>(std::ceil(light_sigmas * blur_px - 0.5)));
}

constexpr double kOnePercent = 2.33;  // sigmas of a normal distribution
/// Beside a dark background, where no other phase mixes in and that of the surface is corrected.
constexpr double kFivePercent = 1.645;

/// Whether a neighbour of a measured pixel is measured, but not connected to it.
bool at_depth_step(const PixelConnections& connections, int x, int y) {
  for (int i = 0; i < PixelConnections::SideCount; ++i) {
    const auto side = static_cast<PixelConnections::Side>(i);
    const auto [dx, dy] = PixelConnections::kOffsets[static_cast<std::size_t>(i)];
    if (connections.broken(x, y, side) || connections.broken(x - dx, y - dy, side)) return true;
  }
  return false;
}

/// Whether a pixel farther away than a neighbour, up to `reach_px`, is measured and not connected
/// to a measured one: a step lies between them, also where its own pixels have no depth.
bool near_depth_step(const Grid& grid, float slope, int reach_px, int x, int y) {
  const auto& depth = grid.range.depth_mm;
  constexpr std::array<std::array<int, 2>, 8> kAround{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (int k = 2; k <= reach_px; ++k) {
    for (const auto& [dx, dy] : kAround) {
      const Eigen::Vector2i p(x + k * dx, y + k * dy);
      if (p.minCoeff() < 0 || p.x() >= depth.width() || p.y() >= depth.height()) continue;
      if (std::isnan(depth(p.x(), p.y()))) continue;
      if (!is_connected(grid.range, grid.rays, {x, y}, p, slope)) return true;
    }
  }
  return false;
}

/// Whether a depth step too low for `at_depth_step` lies between the pixels (x, y) - d and
/// (x, y) + d, see `is_depth_step`.
bool is_low_step(
    const Grid& grid, const MixedPixelOptions& options, int x, int y, const Eigen::Vector2i& d) {
  const auto& depth = grid.range.depth_mm;
  const auto at = [&](int k) {
    const int u = x + k * d.x();
    const int v = y + k * d.y();
    const bool inside = u >= 0 && v >= 0 && u < depth.width() && v < depth.height();
    return inside ? depth(u, v) : kMissing;
  };
  const float jump = at(1) - at(-1);
  if (std::isnan(jump)) return false;
  const float pixel_mm = (grid.rays(x, y) - grid.rays(x + d.x(), y + d.y())).norm() * at(-1);
  const float noise = 2.0F * grid.range.sigma_mm(x, y);  // of the jump minus its prediction
  const DepthChange change{jump, at(-1) - at(-3), at(3) - at(1)};  // each over two pixels
  return is_depth_step(change,
                       static_cast<float>(options.min_step_px) * pixel_mm +
                           static_cast<float>(options.min_step_sigmas) * noise);
}

/// Whether a pixel lies within `reach_px` of the background, which is unmodulated.
bool at_silhouette(const Image<PixelStatus>& status, int least_dark, int reach_px, int x, int y) {
  int dark = 0;
  const int bottom = std::min(status.height() - 1, y + reach_px);
  const int right = std::min(status.width() - 1, x + reach_px);
  for (int v = std::max(0, y - reach_px); v <= bottom; ++v) {
    for (int u = std::max(0, x - reach_px); u <= right; ++u)
      dark += status(u, v) == PixelStatus::Unmodulated ? 1 : 0;
  }
  return dark >= least_dark;
}

struct Pixel {
  int x;
  int y;
};

/// Marks the pixels of connected patches with fewer than `min_px` pixels.
void mark_small_patches(const Grid& grid,
                        const PixelConnections& connections,
                        int min_px,
                        Image<std::uint8_t>& remove) {
  constexpr auto kRight = PixelConnections::Right;
  constexpr auto kDown = PixelConnections::Down;
  const PixelBox& box = grid.box;
  Image<std::uint8_t> seen = remove;
  std::vector<Pixel> patch;
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      if (seen(x, y) != 0 || std::isnan(grid.range.depth_mm(x, y))) continue;
      patch.assign(1, {x, y});
      seen(x, y) = 1;
      for (std::size_t head = 0; head < patch.size(); ++head) {
        const Pixel p = patch[head];
        const auto visit = [&](bool connected, int u, int v) {
          if (!connected || seen(u, v) != 0) return;
          seen(u, v) = 1;
          patch.push_back({u, v});
        };
        visit(connections.connected(p.x - 1, p.y, kRight), p.x - 1, p.y);
        visit(connections.connected(p.x, p.y, kRight), p.x + 1, p.y);
        visit(connections.connected(p.x, p.y - 1, kDown), p.x, p.y - 1);
        visit(connections.connected(p.x, p.y, kDown), p.x, p.y + 1);
      }
      if (patch.size() >= static_cast<std::size_t>(min_px)) continue;
      for (const Pixel& p : patch)
        remove(p.x, p.y) = 1;
    }
  }
}

/// Marks the pixel at each low step and those within `reach_px` across the step.
void mark_low_steps(const Grid& grid,
                    const MixedPixelOptions& options,
                    int reach_px,
                    Image<std::uint8_t>& remove) {
  enum Step : std::uint8_t { Across = 1, Down = 2 };
  const PixelBox& box = grid.box;
  const int width = remove.width();
  const int height = remove.height();
  Image<std::uint8_t> steps(width, height, 0);
  parallel_rows(box.height(), [&](int row) {
    const int y = box.top + row;
    const bool within = y > 0 && y + 1 < height;
    for (int x = box.left; x < box.right; ++x) {
      if (std::isnan(grid.range.depth_mm(x, y))) continue;  // its sigma is missing, too
      const bool across = x > 0 && x + 1 < width && is_low_step(grid, options, x, y, {1, 0});
      const bool down = within && is_low_step(grid, options, x, y, {0, 1});
      steps(x, y) = static_cast<std::uint8_t>((across ? Across : 0) | (down ? Down : 0));
    }
  });
  parallel_rows(box.height(), [&](int row) {
    const int y = box.top + row;
    for (int x = box.left; x < box.right; ++x) {
      int across = 0;
      int down = 0;
      for (int k = -reach_px; k <= reach_px; ++k) {
        across |= steps(std::clamp(x + k, 0, width - 1), y);
        down |= steps(x, std::clamp(y + k, 0, height - 1));
      }
      if ((across & Across) != 0 || (down & Down) != 0) remove(x, y) = 1;
    }
  });
}

}  // namespace

std::vector<RangePixel> remove_mixed_pixels(RangeGrid& range,
                                            const Image<Eigen::Vector2f>& rays,
                                            Image<PixelStatus>& status,
                                            const MixedPixelOptions& options) {
  require(same_size(range.depth_mm, rays) && same_size(range.depth_mm, status),
          "remove_mixed_pixels: range, rays and status differ in size");
  const auto slope = static_cast<float>(std::tan(rad_from_deg(options.max_incidence_deg)));
  const PixelBox box = measured_box(range.depth_mm);
  const Grid grid{range, rays, box};
  const PixelConnections connections = connect_pixels(range, rays, box, slope);
  const int reach_px = mixed_reach_px(options.blur_px, kOnePercent);
  const int dark_px = mixed_reach_px(options.blur_px, kFivePercent);
  const int least_dark = options.min_dark_neighbors + 2 * (dark_px - 1);  // a row of the window
  Image<std::uint8_t> remove(rays.width(), rays.height(), 0);
  parallel_rows(box.height(), [&](int row) {
    const int y = box.top + row;
    for (int x = box.left; x < box.right; ++x) {
      if (std::isnan(range.depth_mm(x, y))) continue;
      const bool mixed = at_depth_step(connections, x, y) ||
                         near_depth_step(grid, slope, reach_px, x, y) ||
                         at_silhouette(status, least_dark, dark_px, x, y);
      remove(x, y) = mixed ? 1 : 0;
    }
  });
  // The pixels at both sides of a step find it, so that one more is marked than its reach says.
  mark_low_steps(grid, options, std::max(1, reach_px - 1), remove);
  mark_small_patches(grid, connections, options.min_patch_px, remove);
  std::vector<RangePixel> removed;
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      if (remove(x, y) == 0 || std::isnan(range.depth_mm(x, y))) continue;
      removed.push_back(range.pixel(x, y));
      range.remove(x, y);
      status(x, y) = PixelStatus::MixedPixel;
    }
  }
  return removed;
}

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
