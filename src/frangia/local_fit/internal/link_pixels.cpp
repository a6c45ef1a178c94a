#include "frangia/local_fit/internal/link_pixels.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

constexpr float kMaxSlope = 7.1F;        // tan(82 degrees), the limit of `MixedPixelOptions`
constexpr float kNoiseSigmas = 4.0F;     // minimum depth step
constexpr float kSmallestSigma = 1e-6F;  // per depth: keeps the weight of noise-free data finite

/// A row of inverse depths and their noise.
struct GridRow {
  const float* q;
  const float* noise;
};
struct LinkRow {
  LinkedPixels::Link which;
  std::uint8_t* links;
  int count;
};

/// Links the pixels of one row to those of another. Missing pixels have no links.
FRANGIA_VECTORIZED void link_row(const GridRow& from,
                                 const GridRow& to,
                                 float steepest,
                                 const LinkRow& row) {
  const auto [q, noise] = from;
  const auto [other_q, other_noise] = to;
  const auto [which, links, count] = row;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float here = q[x];
    const float there = other_q[x];
    const float slope = std::max(here, there) * steepest;
    const float far = kNoiseSigmas * std::max(noise[x], other_noise[x]);
    const bool linked = std::abs(here - there) < slope + far;  // false for NaN
    links[x] = static_cast<std::uint8_t>(links[x] | (linked ? which : 0));
  }
}

/// A row of depths and their standard deviations.
struct DepthRow {
  const float* depth_mm;
  const float* sigma_mm;
};

/// Computes the inverse depths of a row and their noise.
FRANGIA_VECTORIZED void invert_row(const DepthRow& row, int count, float* q, float* noise) {
  const auto [depths_mm, sigmas_mm] = row;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float depth = depths_mm[x];
    const float sigma = std::max(sigmas_mm[x], kSmallestSigma * depth);
    const bool seen = depth > 0.0F && sigma >= 0.0F;
    q[x] = seen ? 1.0F / depth : kMissing;
    noise[x] = sigma / (depth * depth);
  }
}

}  // namespace

LinkedPixels link_pixels(const RangeGrid& range, const CameraModel& camera, const PixelBox& box) {
  const PixelBox part = box.within(range.depth_mm.width(), range.depth_mm.height());
  const int width = part.width();
  const int height = part.height();
  LinkedPixels grid{Image<float>(width, height, Uninitialized{}),
                    Image<float>(width, height, Uninitialized{}),
                    Image<std::uint8_t>(width, height)};
  parallel_rows(height, [&](int y) {
    invert_row({&range.depth_mm(part.left, part.top + y), &range.sigma_mm(part.left, part.top + y)},
               width,
               &grid.q(0, y),
               &grid.noise(0, y));
  });
  const auto steepest = static_cast<float>(kMaxSlope / camera.focal_px.mean());
  parallel_rows(height, [&](int y) {
    std::uint8_t* links = &grid.links(0, y);
    link_row({&grid.q(0, y), &grid.noise(0, y)},
             {&grid.q(0, y) + 1, &grid.noise(0, y) + 1},
             steepest,
             {LinkedPixels::Right, links, width - 1});
    if (y + 1 == height) return;
    link_row({&grid.q(0, y), &grid.noise(0, y)},
             {&grid.q(0, y + 1), &grid.noise(0, y + 1)},
             steepest,
             {LinkedPixels::Down, links, width});
  });
  return grid;
}

}  // namespace frangia
