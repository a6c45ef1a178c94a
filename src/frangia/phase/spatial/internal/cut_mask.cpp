#include "frangia/phase/spatial/internal/cut_mask.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/spatial/find_residues.h"

namespace frangia {
namespace {

/// Marks pairs of measured pixels whose difference is not smooth.
FRANGIA_VECTORIZED void mark_broken(const float* __restrict a,
                                    const float* __restrict b,
                                    const std::uint8_t* __restrict smooth,
                                    int count,
                                    std::uint8_t* __restrict broken) {
  for (int x = 0; x < count; ++x) {
    const float both = a[x] + b[x];
    const auto cut = static_cast<std::uint8_t>((both == both ? 1 : 0) & (smooth[x] ^ 1));
    broken[x] = static_cast<std::uint8_t>(broken[x] | cut);
  }
}

/// Marks pixels with a measured neighbour across a difference that is not smooth.
Image<std::uint8_t> broken_pixels(const Image<float>& phase, const SmoothSteps& smooth) {
  const int width = phase.width();
  const int height = phase.height();
  Image<std::uint8_t> broken(width, height, Uninitialized{});
  const auto row_of = [&](const auto& image, int y) {
    return image.pixels().data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  };
  parallel_rows(height, [&](int y) {
    std::vector<std::uint8_t> right(static_cast<std::size_t>(width) + 1, 0);
    const float* row = row_of(phase, y);
    mark_broken(row, row + 1, row_of(smooth.right, y), width - 1, right.data() + 1);
    std::uint8_t* out = &broken(0, y);
    for (std::size_t x = 0; x + 1 < right.size(); ++x)
      out[x] = static_cast<std::uint8_t>(right[x] | right[x + 1]);
    if (y > 0) mark_broken(row - width, row, row_of(smooth.below, y - 1), width, out);
    if (y + 1 < height) mark_broken(row, row + width, row_of(smooth.below, y), width, out);
  });
  return broken;
}

FRANGIA_VECTORIZED void widen(std::uint8_t* __restrict into,
                              const std::uint8_t* __restrict from,
                              std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    into[i] = into[i] > from[i] ? into[i] : from[i];
}

/// Dilates a mask by a square of this radius, one direction at a time.
void dilate(int radius, Image<std::uint8_t>& mask) {
  const int width = mask.width();
  const int height = mask.height();
  parallel_rows(height, [&](int y) {
    int last = -2 * radius - width;
    std::vector<int> before;
    for (int x = 0; x < width; ++x) {
      if (mask(x, y) != 0) before.push_back(x);
    }
    for (const int x : before) {
      for (int u = std::max({0, x - radius, last + 1}); u <= std::min(width - 1, x + radius); ++u)
        mask(u, y) = 1;
      last = std::min(width - 1, x + radius);
    }
  });
  if (height < 2) return;
  const auto row = static_cast<std::size_t>(width);
  const Image<std::uint8_t> across = mask;
  parallel_rows(height, [&](int y) {
    for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v) {
      if (v != y) widen(&mask(0, y), &across(0, v), row);
    }
  });
}

}  // namespace

Image<std::uint8_t> mark_near_cuts(const Image<float>& phase_rad,
                                   const SmoothSteps& smooth,
                                   int radius_px) {
  Image<std::uint8_t> mask = broken_pixels(phase_rad, smooth);
  dilate(radius_px, mask);
  return mask;
}

std::size_t discard_residues(WrappedPhase& phase) {
  std::size_t discarded = 0;
  for (const Residue& residue : find_residues(phase.phase_rad)) {
    for (int corner = 0; corner < 4; ++corner) {
      const int x = residue.x + corner % 2;
      const int y = residue.y + corner / 2;
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      phase.status(x, y) = PixelStatus::Residue;
      phase.phase_rad(x, y) = kMissing;
      phase.sigma_rad(x, y) = kMissing;
      if (!phase.systematic_rad.empty()) phase.systematic_rad(x, y) = kMissing;
      ++discarded;
    }
  }
  return discarded;
}

}  // namespace frangia
