#include "frangia/phase/discard_residues.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorised.h"

namespace frangia {
namespace {

/// Whole turns in the jump from `a` to `b`: what wrapping it takes away.
[[gnu::always_inline]] inline std::int32_t turns(float a, float b) {
  const float difference = b - a;
  return (difference > 3.14159265F ? 1 : 0) - (difference < -3.14159265F ? 1 : 0);
}

/// Loops between two rows. The jumps themselves sum to zero; the turns taken away must do so too.
/// A loop with a missing pixel is none.
FRANGIA_VECTORISED void find_loops(const float* __restrict above,
                                   const float* __restrict below,
                                   int count,
                                   std::int32_t* __restrict residue) {
  for (int x = 0; x < count; ++x) {
    const float a = above[x];
    const float b = above[x + 1];
    const float c = below[x + 1];
    const float d = below[x];
    const std::int32_t sum = turns(a, b) + turns(b, c) + turns(c, d) + turns(d, a);
    const float all = a + b + c + d;
    residue[x] = all == all ? sum : 0;
  }
}

}  // namespace

std::size_t discard_residues(WrappedPhase& phase) {
  const int width = phase.phase_rad.width();
  const int height = phase.phase_rad.height();
  if (width < 2 || height < 2) return 0;
  const auto row = static_cast<std::size_t>(width);
  const float* rad = phase.phase_rad.pixels().data();
  std::vector<std::vector<int>> cores(static_cast<std::size_t>(height));  // of loops: left pixel
  parallel_rows(height - 1, [&](int y) {
    std::vector<std::int32_t> residue(row - 1);
    const float* above = rad + static_cast<std::size_t>(y) * row;
    find_loops(above, above + row, width - 1, residue.data());
    for (int x = 0; x + 1 < width; ++x) {
      if (residue[static_cast<std::size_t>(x)] != 0)
        cores[static_cast<std::size_t>(y)].push_back(x);
    }
  });
  std::size_t discarded = 0;
  for (int y = 0; y + 1 < height; ++y) {
    for (const int x : cores[static_cast<std::size_t>(y)]) {
      for (int corner = 0; corner < 4; ++corner) {
        const int px = x + corner % 2;
        const int py = y + corner / 2;
        if (phase.fate(px, py) != PixelFate::Measured) continue;
        phase.fate(px, py) = PixelFate::Residue;
        phase.phase_rad(px, py) = kMissing;
        phase.sigma_rad(px, py) = kMissing;
        ++discarded;
      }
    }
  }
  return discarded;
}

}  // namespace frangia
