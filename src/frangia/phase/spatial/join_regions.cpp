#include "frangia/phase/spatial/join_regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/phase/internal/fringe_forest.h"

namespace frangia {
namespace {

/// The border between two regions: how often each whole number of fringes is implied.
struct Border {
  int length = 0;
  std::map<int, int> votes;
};
using Borders = std::map<std::pair<std::uint32_t, std::uint32_t>, Border>;

/// Two neighbouring pixels of different regions.
struct Contact {
  int a;        ///< region of the left or upper pixel
  int b;        ///< region of the right or lower pixel
  int fringes;  ///< fringes to add to b for the smallest difference
  bool smooth;
};

/// Collects the contacts row by row, once, because borders are a small part of an image and are
/// traversed several times.
std::vector<Contact> all_contacts(const RelativePhase& phase, const Regions& regions) {
  const int width = phase.region.width();
  const int height = phase.region.height();
  std::vector<std::vector<Contact>> rows(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    const auto look = [&](int x, int u, int v, bool smooth) {
      const int a = phase.region(x, y);
      const int b = phase.region(u, v);
      if (a == b || a < 0 || b < 0) return;
      const double jump = phase.phase_rad(x, y) - phase.phase_rad(u, v);
      const int fringes = static_cast<int>(std::lround(jump / kTwoPi));
      rows[static_cast<std::size_t>(y)].push_back({a, b, fringes, smooth});
    };
    // Most blocks lie within one region, together with the pixels to their right and below.
    const std::int32_t* here = &phase.region(0, y);
    const std::int32_t* below = y + 1 < height ? here + width : here;
    constexpr int kBlock = 32;  // labels per comparison: two cache lines
    for (int begin = 0; begin < width; begin += kBlock) {
      const int end = std::min(width, begin + kBlock);
      const int last = std::min(width - 1, end);
      if (std::equal(here + begin, here + last, here + begin + 1) &&
          std::equal(here + begin, here + end, below + begin))
        continue;
      for (int x = begin; x < end; ++x) {
        if (x + 1 < width) look(x, x + 1, y, regions.smooth_right(x, y) != 0);
        if (y + 1 < height) look(x, x, y + 1, regions.smooth_below(x, y) != 0);
      }
    }
  });
  std::vector<Contact> all;
  for (const auto& row : rows)
    all.insert(all.end(), row.begin(), row.end());
  return all;
}

Borders all_borders(const std::vector<Contact>& contacts, FringeForest& forest) {
  Borders borders;
  for (const Contact& contact : contacts) {
    auto a = forest.root(static_cast<std::size_t>(contact.a));
    auto b = forest.root(static_cast<std::size_t>(contact.b));
    if (a.index == b.index) continue;
    int fringes = contact.fringes + a.fringes - b.fringes;
    if (a.index > b.index) {
      std::swap(a, b);
      fringes = -fringes;
    }
    Border& border = borders[{a.index, b.index}];
    ++border.length;
    if (contact.smooth) ++border.votes[fringes];
  }
  return borders;
}

/// Joins across the safe borders, longest first; returns the number of joins.
int merge_safe(const Borders& borders,
               double min_agreement,
               std::size_t count,
               FringeForest& forest) {
  struct Merge {
    int votes;
    std::uint32_t keep;
    std::uint32_t give;
    int fringes;
  };
  std::vector<Merge> merges;
  for (const auto& [pair, border] : borders) {
    const auto best = std::max_element(
        border.votes.begin(), border.votes.end(), [](const auto& a, const auto& b) {
          return a.second < b.second;
        });
    if (best == border.votes.end()) continue;
    if (best->second < min_agreement * border.length) continue;
    merges.push_back({best->second, pair.first, pair.second, best->first});
  }
  std::stable_sort(merges.begin(), merges.end(), [](const Merge& a, const Merge& b) {
    return a.votes > b.votes;
  });
  int merged = 0;
  std::vector<bool> changed(count, false);
  for (const Merge& merge : merges) {
    // A region that has just changed is considered again in the next pass, with its new border.
    if (changed[merge.keep] || changed[merge.give]) continue;
    forest.join(merge.keep, merge.give, merge.fringes);
    changed[merge.give] = true;
    ++merged;
  }
  return merged;
}

void relabel_from_largest(RelativePhase& phase, FringeForest& forest) {
  std::vector<std::size_t> sizes(static_cast<std::size_t>(phase.region_count), 0);
  std::vector<FringeForest::Root> roots;
  for (std::size_t region = 0; region < sizes.size(); ++region)
    roots.push_back(forest.root(region));
  const auto labels = phase.region.pixels();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    const auto [root, fringes] = roots[static_cast<std::size_t>(labels[i])];
    phase.phase_rad.pixels()[i] += static_cast<float>(kTwoPi * fringes);
    labels[i] = static_cast<std::int32_t>(root);
    ++sizes[root];
  }
  std::vector<int> order(sizes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return sizes[static_cast<std::size_t>(a)] > sizes[static_cast<std::size_t>(b)];
  });
  std::vector<std::int32_t> rank(sizes.size(), -1);
  phase.region_count = 0;
  for (const int region : order) {
    if (sizes[static_cast<std::size_t>(region)] > 0)
      rank[static_cast<std::size_t>(region)] = phase.region_count++;
  }
  for (auto& label : labels) {
    if (label >= 0) label = rank[static_cast<std::size_t>(label)];
  }
}

}  // namespace

void join_regions(RelativePhase& phase, const Regions& regions, const JoinOptions& options) {
  const auto count = static_cast<std::size_t>(phase.region_count);
  FringeForest forest(count);
  const std::vector<Contact> contacts = all_contacts(phase, regions);
  while (merge_safe(all_borders(contacts, forest), options.min_agreement, count, forest) > 0) {
  }
  relabel_from_largest(phase, forest);
}

}  // namespace frangia
