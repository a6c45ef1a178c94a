#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/core/parallel.h"

namespace frangia {

/// Connected pixels [begin, end) of one row.
struct PixelRun {
  std::int32_t begin;
  std::int32_t end;
};

/// The runs of an image, row by row. The runs of row y have the indices first[y] to first[y + 1] -
/// 1.
struct PixelRuns {
  std::vector<PixelRun> runs;
  std::vector<std::size_t> first;
};

/// Cuts every row into runs of pixels that `inside(x, y)` admits. A run also ends where `joined(x,
/// y)` is false for a pixel and its right-hand neighbour.
template <typename Inside, typename Joined>
[[nodiscard]] PixelRuns find_runs(int width,
                                  int height,
                                  const Inside& inside,
                                  const Joined& joined) {
  std::vector<std::vector<PixelRun>> rows(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    auto& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < width; ++x) {
      if (!inside(x, y)) continue;
      const int begin = x;
      while (x + 1 < width && joined(x, y) && inside(x + 1, y))
        ++x;
      row.push_back({begin, x + 1});
    }
  });
  PixelRuns out;
  out.first.push_back(0);
  for (const auto& row : rows) {
    out.runs.insert(out.runs.end(), row.begin(), row.end());
    out.first.push_back(out.runs.size());
  }
  return out;
}

/// Calls `visit(a, b, begin, end)` for each pair of a run `a` of row y - 1 and a run `b` of row y
/// that share the columns [begin, end).
template <typename Visit>
void for_each_overlap_above(const PixelRuns& all, int y, const Visit& visit) {
  if (y == 0) return;
  const auto row = static_cast<std::size_t>(y);
  std::size_t a = all.first[row - 1];
  std::size_t b = all.first[row];
  while (a < all.first[row] && b < all.first[row + 1]) {
    const std::int32_t begin =
        all.runs[a].begin > all.runs[b].begin ? all.runs[a].begin : all.runs[b].begin;
    const std::int32_t end = all.runs[a].end < all.runs[b].end ? all.runs[a].end : all.runs[b].end;
    if (begin < end) visit(a, b, begin, end);
    ++(all.runs[a].end < all.runs[b].end ? a : b);
  }
}

}  // namespace frangia
