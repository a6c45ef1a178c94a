#include "frangia/phase/spatial/find_residues.h"

#include <cstddef>
#include <cstdint>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

/// Whole turns that wrapping removes from the difference between `a` and `b`.
[[gnu::always_inline]] inline std::int32_t turns(float a, float b) {
  const float difference = b - a;
  return (difference > kPiF ? 1 : 0) - (difference < -kPiF ? 1 : 0);
}

/// Finds the residues between two rows. The unwrapped differences around a loop sum to zero, so the
/// sum of the removed turns is the charge. The charge is 0 for a loop with a missing pixel.
FRANGIA_VECTORIZED void find_loops(const float* __restrict above,
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
    residue[x] = all == all ? -sum : 0;
  }
}

}  // namespace

std::vector<Residue> find_residues(const Image<float>& phase_rad) {
  const int width = phase_rad.width();
  const int height = phase_rad.height();
  if (width < 2 || height < 2) return {};
  const auto row = static_cast<std::size_t>(width);
  std::vector<std::vector<Residue>> rows(static_cast<std::size_t>(height));
  parallel_rows(height - 1, [&](int y) {
    std::vector<std::int32_t> loops(row - 1);
    const float* above = phase_rad.pixels().data() + static_cast<std::size_t>(y) * row;
    find_loops(above, above + row, width - 1, loops.data());
    for (int x = 0; x + 1 < width; ++x) {
      const std::int32_t turns = loops[static_cast<std::size_t>(x)];
      if (turns != 0) rows[static_cast<std::size_t>(y)].push_back({x, y, turns});
    }
  });
  std::vector<Residue> all;
  for (const auto& found : rows)
    all.insert(all.end(), found.begin(), found.end());
  return all;
}

}  // namespace frangia
