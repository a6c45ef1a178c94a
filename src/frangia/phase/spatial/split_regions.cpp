#include "frangia/phase/spatial/split_regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/disjoint_sets.h"
#include "frangia/core/parallel.h"
#include "frangia/core/pixel_buffer.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/fringe_forest.h"
#include "frangia/phase/internal/pixel_runs.h"
#include "frangia/phase/spatial/internal/cut_mask.h"
#include "frangia/phase/wrap/smooth_jumps.h"

namespace frangia {
namespace {

/// A connection narrower than twice this radius beside a cut does not join two regions, px. A depth
/// step of varying height looks smooth where it crosses a whole number of fringes; the faster its
/// height varies, the shorter that part. At 0.03 rad of noise 6 px are enough where the height
/// changes by 0.05 rad per pixel (`UnwrapSpatially.NeverJoinsAcrossAStepOfMoreThanHalfAFringe`; 3
/// px fail), and 24 px where it changes by 0.02. A step that changes more slowly is not detected.
constexpr int kNeckRadius_px = 12;

using Mask = Image<std::uint8_t>;

/// Indices of pixels in the order of their visit.
using PixelQueue = LargeVector<std::uint32_t>;

/// Grows labels across smooth differences, breadth first, into pixels that `allowed` admits.
template <typename Allowed>
void grow_labels(PixelQueue& queue, Regions& regions, const Allowed& allowed) {
  const auto width = static_cast<std::uint32_t>(regions.label.width());
  const auto height = static_cast<std::uint32_t>(regions.label.height());
  const auto label = regions.label.pixels();
  const auto right = regions.smooth_right.pixels();
  const auto below = regions.smooth_below.pixels();
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::uint32_t at = queue[head];
    const std::int32_t own = label[at];
    const auto visit = [&](std::uint32_t to, std::uint8_t smooth) {
      if (smooth == 0 || label[to] >= 0 || !allowed(to)) return;
      label[to] = own;
      queue.push_back(to);
    };
    const std::uint32_t x = at % width;
    if (x > 0) visit(at - 1, right[at - 1]);
    if (x + 1 < width) visit(at + 1, right[at]);
    if (at >= width) visit(at - width, below[at - width]);
    if (at / width + 1 < height) visit(at + width, below[at]);
  }
}

/// Runs of pixels connected by smooth differences and the set of each run.
struct RunSets {
  PixelRuns all;
  DisjointSets sets;
};

template <typename Allowed>
RunSets connect_runs(const Regions& regions, const Allowed& allowed) {
  const int height = regions.label.height();
  PixelRuns all = find_runs(
      regions.label.width(),
      height,
      [&](int x, int y) { return regions.label(x, y) < 0 && allowed(x, y); },
      [&](int x, int y) { return regions.smooth_right(x, y) != 0; });
  DisjointSets sets(all.runs.size());
  for (int y = 1; y < height; ++y) {
    for_each_overlap_above(
        all, y, [&](std::size_t a, std::size_t b, std::int32_t begin, std::int32_t end) {
          const std::uint8_t* smooth = &regions.smooth_below(0, y - 1);
          if (std::find(smooth + begin, smooth + end, 1) != smooth + end)
            sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        });
  }
  return {std::move(all), std::move(sets)};
}

/// Writes the label of each run that has one.
void label_runs(const PixelRuns& all, const std::vector<std::int32_t>& label, Regions& regions) {
  parallel_rows(regions.label.height(), [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = all.first[row]; i < all.first[row + 1]; ++i) {
      if (label[i] < 0) continue;
      std::int32_t* begin = &regions.label(all.runs[i].begin, y);
      std::fill(begin, begin + (all.runs[i].end - all.runs[i].begin), label[i]);
    }
  });
}

/// Assigns a new label to each connected set of admitted, unlabelled pixels.
template <typename Allowed>
void label_all(Regions& regions, const Allowed& allowed) {
  RunSets runs = connect_runs(regions, allowed);
  // The root is the first run of its set.
  std::vector<std::int32_t> label(runs.all.runs.size());
  for (std::size_t i = 0; i < label.size(); ++i) {
    const std::size_t root = runs.sets.find(static_cast<std::uint32_t>(i));
    label[i] = root == i ? regions.count++ : label[root];
  }
  label_runs(runs.all, label, regions);
}

constexpr std::int32_t kNoLabel = -1;
constexpr std::int32_t kSeveral = -2;

/// The only label adjacent to a run across smooth differences; kNoLabel or kSeveral otherwise.
std::int32_t label_adjacent_to(const Regions& regions, int y, PixelRun run) {
  std::int32_t found = kNoLabel;
  const auto visit = [&](int x, int v, std::uint8_t smooth) {
    const std::int32_t label = regions.label(x, v);
    if (smooth == 0 || label < 0 || label == found) return;
    found = found == kNoLabel ? label : kSeveral;
  };
  if (run.begin > 0) visit(run.begin - 1, y, regions.smooth_right(run.begin - 1, y));
  if (run.end < regions.label.width()) visit(run.end, y, regions.smooth_right(run.end - 1, y));
  for (std::int32_t x = run.begin; x < run.end && found != kSeveral; ++x) {
    if (y > 0) visit(x, y - 1, regions.smooth_below(x, y - 1));
    if (y + 1 < regions.label.height()) visit(x, y + 1, regions.smooth_below(x, y));
  }
  return found;
}

/// Labels sets of unlabelled pixels that are adjacent to a single label; equivalent to
/// `grow_labels`, without a queue.
template <typename Allowed>
void label_sets_with_one_neighbor(Regions& regions, const Allowed& allowed) {
  RunSets runs = connect_runs(regions, allowed);
  std::vector<std::int32_t> adjacent(runs.all.runs.size());
  parallel_rows(regions.label.height(), [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = runs.all.first[row]; i < runs.all.first[row + 1]; ++i)
      adjacent[i] = label_adjacent_to(regions, y, runs.all.runs[i]);
  });
  std::vector<std::int32_t> of_set(adjacent.size(), kNoLabel);
  for (std::size_t i = 0; i < adjacent.size(); ++i) {
    std::int32_t& known = of_set[runs.sets.find(static_cast<std::uint32_t>(i))];
    if (adjacent[i] == kNoLabel || adjacent[i] == known) continue;
    known = known == kNoLabel ? adjacent[i] : kSeveral;
  }
  for (std::size_t i = 0; i < adjacent.size(); ++i)
    adjacent[i] = of_set[runs.sets.find(static_cast<std::uint32_t>(i))];
  label_runs(runs.all, adjacent, regions);
}

/// Marks pixels that are near a cut, or above or below such a pixel. All unlabelled pixels are near
/// a cut.
FRANGIA_VECTORIZED void mark_near(const std::uint8_t* above,
                                  const std::uint8_t* here,
                                  const std::uint8_t* below,
                                  std::size_t count,
                                  std::uint8_t* __restrict near) {
  for (std::size_t x = 0; x < count; ++x)
    near[x] = static_cast<std::uint8_t>(above[x] | here[x] | below[x]);
}

/// Labelled pixels adjacent to measured pixels without a label, all of which are near a cut.
PixelQueue growth_seeds(const Image<float>& phase,
                        const Image<std::int32_t>& label,
                        const Mask& near_cut) {
  const int width = label.width();
  const int height = label.height();
  const auto is_unlabeled = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height && label(x, y) < 0 &&
           !std::isnan(phase(x, y));
  };
  std::vector<std::vector<std::uint32_t>> rows(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    std::vector<std::uint8_t> near(static_cast<std::size_t>(width));
    mark_near(&near_cut(0, std::max(0, y - 1)),
              &near_cut(0, y),
              &near_cut(0, std::min(height - 1, y + 1)),
              near.size(),
              near.data());
    const auto begin = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width);
    int done = 0;
    for (auto next = std::find(near.begin(), near.end(), 1); next != near.end();
         next = std::find(next + 1, near.end(), 1)) {
      const int x = static_cast<int>(next - near.begin());
      for (int u = std::max(done, x - 1); u <= std::min(width - 1, x + 1); ++u) {
        done = u + 1;
        if (label(u, y) < 0) continue;
        if (is_unlabeled(u - 1, y) || is_unlabeled(u + 1, y) || is_unlabeled(u, y - 1) ||
            is_unlabeled(u, y + 1))
          rows[static_cast<std::size_t>(y)].push_back(begin + static_cast<std::uint32_t>(u));
      }
    }
  });
  PixelQueue queue;
  for (const auto& row : rows)
    queue.insert(queue.end(), row.begin(), row.end());
  return queue;
}

}  // namespace

Regions split_regions(const WrappedPhase& wrapped, const SplitOptions& options) {
  const Image<float>& phase = wrapped.phase_rad;
  Regions regions{.label = Image<std::int32_t>(phase.width(), phase.height(), -1),
                  .count = 0,
                  .smooth_right = smooth_right(phase, options.jumps),
                  .smooth_below = smooth_below(phase, options.jumps)};
  const Mask near_cut =
      mark_near_cuts(phase, {regions.smooth_right, regions.smooth_below}, kNeckRadius_px);
  const auto measured = [&](int x, int y) { return !std::isnan(phase(x, y)); };
  label_all(regions, [&](int x, int y) { return measured(x, y) && near_cut(x, y) == 0; });
  // Most margins around the cores belong to one core; the others are divided among the nearest
  // cores.
  label_sets_with_one_neighbor(regions,
                               [&](int x, int y) { return near_cut(x, y) != 0 && measured(x, y); });
  PixelQueue queue = growth_seeds(phase, regions.label, near_cut);
  grow_labels(queue, regions, [&](std::uint32_t at) { return !std::isnan(phase.pixels()[at]); });
  label_all(regions, measured);  // pixels that no core reaches
  return regions;
}

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
