#include "frangia/phase/discard_residues.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Whole turns in the jump from `a` to `b`: what wrapping it takes away.
int turns(float a, float b) {
  const float difference = b - a;
  return difference > 3.14159265F ? 1 : difference < -3.14159265F ? -1 : 0;
}

}  // namespace

std::size_t discard_residues(WrappedPhase& phase) {
  const int width = phase.phase_rad.width();
  const int height = phase.phase_rad.height();
  Image<std::uint8_t> residue(width, height, 0);  // the loop's top-left pixel
  const Image<float>& rad = phase.phase_rad;
  parallel_rows(height - 1, [&](int y) {
    for (int x = 0; x + 1 < width; ++x) {
      const float a = rad(x, y);
      const float b = rad(x + 1, y);
      const float c = rad(x + 1, y + 1);
      const float d = rad(x, y + 1);
      if (std::isnan(a + b + c + d)) continue;
      // The jumps themselves sum to zero; the turns taken away must do so too.
      residue(x, y) = turns(a, b) + turns(b, c) + turns(c, d) + turns(d, a) != 0 ? 1 : 0;
    }
  });
  std::size_t discarded = 0;
  for (int y = 0; y + 1 < height; ++y) {
    for (int x = 0; x + 1 < width; ++x) {
      if (residue(x, y) == 0) continue;
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
