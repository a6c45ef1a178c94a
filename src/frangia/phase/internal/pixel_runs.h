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

/// Union-find over runs; each run stores its fringe offset from its parent.
class RunForest {
 public:
  explicit RunForest(std::size_t count) : parent_(count), fringes_(count, 0) {
    for (std::size_t i = 0; i < count; ++i)
      parent_[i] = static_cast<std::uint32_t>(i);
  }
  struct Root {
    std::uint32_t run;
    std::int32_t fringes;  ///< fringes to add to the run to be level with its root
  };
  [[nodiscard]] Root root(std::size_t run) {
    auto at = static_cast<std::uint32_t>(run);
    std::int32_t fringes = 0;
    while (parent_[at] != at) {
      // Path halving.
      const std::uint32_t up = parent_[at];
      fringes_[at] += fringes_[up];
      parent_[at] = parent_[up];
      fringes += fringes_[at];
      at = parent_[at];
    }
    return {at, fringes};
  }
  /// Joins the sets of `a` and `b`; `fringes` is added to `b` to be level with `a`. The root with
  /// the smaller index stays a root. Runs that are already in one set are unchanged.
  void join(std::size_t a, std::size_t b, std::int32_t fringes) {
    const Root above = root(a);
    const Root below = root(b);
    if (above.run == below.run) return;
    const std::int32_t apart = fringes + above.fringes - below.fringes;
    if (above.run < below.run) {
      parent_[below.run] = above.run;
      fringes_[below.run] = apart;
    } else {
      parent_[above.run] = below.run;
      fringes_[above.run] = -apart;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::int32_t> fringes_;
};

}  // namespace frangia
