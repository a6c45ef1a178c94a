#include "frangia/phase/spatial/internal/unwrap_run_merging.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/phase/internal/fringe_forest.h"
#include "frangia/phase/internal/pixel_runs.h"

namespace frangia {
namespace {

/// Least number of unanimous votes of a safe join. Fewer pixels may all be wrong.
constexpr std::int32_t kSafe = 8;

struct Link {
  std::uint32_t above;
  std::uint32_t below;
  std::int32_t fringes;
  std::int32_t votes;
};

/// Whole turns of each pixel relative to the first pixel of its run.
void count_turns(const float* phase, PixelRun run, std::int16_t* turns) {
  std::int32_t turn = 0;
  turns[run.begin] = 0;
  for (std::int32_t x = run.begin + 1; x < run.end; ++x) {
    const float jump = phase[x] - phase[x - 1];
    turn += (jump < -kPiF ? 1 : 0) - (jump > kPiF ? 1 : 0);
    turns[x] = static_cast<std::int16_t>(turn);
  }
}

/// The vote of the shared columns of two runs: the majority number of fringes, its margin, and
/// whether all pixels agree.
struct Vote {
  std::int32_t fringes = 0;
  std::int32_t votes = 0;
  bool unanimous = true;
};

class OverlapVotes {
 public:
  OverlapVotes(const WrappedPhase& phase, const Regions& regions, const Image<std::int16_t>& turns)
      : phase_(phase.phase_rad), regions_(regions), turns_(turns) {}

  [[nodiscard]] Vote count(int y, std::int32_t begin, std::int32_t end) const {
    Vote vote;
    for (std::int32_t x = begin; x < end; ++x) {
      if (regions_.smooth_below(x, y - 1) == 0) continue;
      const float jump = phase_(x, y) - phase_(x, y - 1);
      const std::int32_t fringes =
          turns_(x, y - 1) - turns_(x, y) + (jump < -kPiF ? 1 : 0) - (jump > kPiF ? 1 : 0);
      // Boyer-Moore majority vote; exact when one number has more than half of the votes.
      if (vote.votes == 0) vote.fringes = fringes;
      const bool agrees = vote.fringes == fringes;
      vote.unanimous = vote.unanimous && agrees;
      vote.votes += agrees ? 1 : -1;
    }
    return vote;
  }

 private:
  const Image<float>& phase_;
  const Regions& regions_;
  const Image<std::int16_t>& turns_;
};

/// Joins the safe overlaps; returns the other links by descending votes.
std::vector<Link> join_safe(const PixelRuns& all,
                            const OverlapVotes& overlap,
                            int height,
                            const Image<std::int32_t>& label,
                            FringeForest& forest) {
  std::vector<std::vector<Link>> rows(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    for_each_overlap_above(
        all, y, [&](std::size_t a, std::size_t b, std::int32_t begin, std::int32_t end) {
          if (label(begin, y) != label(begin, y - 1)) return;
          const Vote vote = overlap.count(y, begin, end);
          if (vote.votes == 0) return;
          const std::int32_t weight = vote.unanimous && vote.votes >= kSafe ? -1 : vote.votes;
          rows[static_cast<std::size_t>(y)].push_back(
              {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), vote.fringes, weight});
        });
  });
  std::vector<Link> uncertain;
  for (const auto& row : rows) {
    for (const Link& link : row) {
      if (link.votes < 0) {
        forest.join(link.above, link.below, link.fringes);
      } else {
        uncertain.push_back(link);
      }
    }
  }
  std::stable_sort(uncertain.begin(), uncertain.end(), [](const Link& a, const Link& b) {
    return a.votes > b.votes;
  });
  return uncertain;
}

}  // namespace

std::vector<std::uint32_t> best_pixels(const Image<float>& modulation,
                                       const Image<std::int32_t>& label,
                                       int count) {
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> best(static_cast<std::size_t>(count), kNone);
  std::vector<float> most(best.size());
  for (std::size_t i = 0; i < label.pixels().size(); ++i) {
    if (label.pixels()[i] < 0) continue;
    const auto region = static_cast<std::size_t>(label.pixels()[i]);
    if (best[region] != kNone && !(modulation.pixels()[i] > most[region])) continue;
    best[region] = static_cast<std::uint32_t>(i);
    most[region] = modulation.pixels()[i];
  }
  return best;
}

RelativePhase unwrap_run_merging(WrappedPhase&& phase, Regions& regions) {
  const int width = phase.phase_rad.width();
  const int height = phase.phase_rad.height();
  const Image<std::int32_t>& label = regions.label;
  const PixelRuns all = find_runs(
      width,
      height,
      [&](int x, int y) { return label(x, y) >= 0; },
      [&](int x, int y) {
        return regions.smooth_right(x, y) != 0 && label(x, y) == label(x + 1, y);
      });
  Image<std::int16_t> turns(width, height, Uninitialized{});
  const auto row_of = [&](auto& image, int y) {
    return image.pixels().data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  };
  parallel_rows(height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = all.first[row]; i < all.first[row + 1]; ++i)
      count_turns(row_of(phase.phase_rad, y), all.runs[i], row_of(turns, y));
  });
  FringeForest forest(all.runs.size());
  for (const Link& link : join_safe(all, {phase, regions, turns}, height, label, forest))
    forest.join(link.above, link.below, link.fringes);

  std::vector<std::int32_t> level(all.runs.size());
  for (std::size_t i = 0; i < level.size(); ++i)
    level[i] = forest.root(i).fringes;
  // Subtract the order of the best pixel from its whole region.
  const auto best = best_pixels(phase.modulation_counts, label, regions.count);
  std::vector<std::int32_t> zero(best.size(), 0);
  for (std::size_t region = 0; region < best.size(); ++region) {
    const auto x = static_cast<std::int32_t>(best[region] % static_cast<std::uint32_t>(width));
    const auto y = static_cast<int>(best[region] / static_cast<std::uint32_t>(width));
    std::size_t i = all.first[static_cast<std::size_t>(y)];
    while (all.runs[i].end <= x)
      ++i;
    zero[region] = turns(x, y) + level[i];
  }
  parallel_rows(height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    float* rad = row_of(phase.phase_rad, y);
    for (std::size_t i = all.first[row]; i < all.first[row + 1]; ++i) {
      const PixelRun run = all.runs[i];
      const std::int32_t above = level[i] - zero[static_cast<std::size_t>(label(run.begin, y))];
      for (std::int32_t x = run.begin; x < run.end; ++x)
        rad[x] += kTwoPiF * static_cast<float>(turns(x, y) + above);
    }
  });
  return {.pattern = std::move(phase.pattern),
          .phase_rad = std::move(phase.phase_rad),
          .sigma_rad = std::move(phase.sigma_rad),
          .region = std::move(regions.label),
          .region_count = regions.count,
          .status = std::move(phase.status),
          .growth_order = {},
          .systematic_rad = std::move(phase.systematic_rad)};
}

}  // namespace frangia
