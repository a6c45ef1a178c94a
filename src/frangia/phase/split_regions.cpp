#include "frangia/phase/split_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorised.h"
#include "frangia/phase/pixel_runs.h"

namespace frangia {
namespace {

using Mask = Image<std::uint8_t>;

/// Wrapped jumps between two rows, or a row and itself one pixel on; NaN where an end is missing.
FRANGIA_VECTORISED void find_jumps(const float* from, const float* to, int count, float* jump) {
  for (int x = 0; x < count; ++x) {
    const float difference = to[x] - from[x];
    const float down = difference > 3.14159265F ? 6.28318531F : 0.0F;
    const float up = difference < -3.14159265F ? 6.28318531F : 0.0F;
    jump[x] = difference - down + up;
  }
}

struct Limits {
  float departure;  ///< from the jumps before and behind
  float jump;
};

/// Whether each jump is smooth: small, and not far outside the ones before and behind it. One that
/// is missing is passed over, and a lone jump has no departure.
FRANGIA_VECTORISED void judge_jumps(const float* before,
                                    const float* here,
                                    const float* behind,
                                    int count,
                                    Limits limits,
                                    std::uint8_t* smooth) {
  for (int x = 0; x < count; ++x) {
    const float jump = here[x];
    const float one = before[x] == before[x] ? before[x] : behind[x];
    const float two = behind[x] == behind[x] ? behind[x] : before[x];
    const float low = one < two ? one : two;
    const float high = one < two ? two : one;
    const std::int32_t below = low - jump > limits.departure ? 1 : 0;
    const std::int32_t above = jump - high > limits.departure ? 1 : 0;
    const std::int32_t small = std::fabs(jump) <= limits.jump ? 1 : 0;
    smooth[x] = static_cast<std::uint8_t>(small & ~(below | above) & 1);
  }
}

/// Standard deviation of the jumps' noise along x (dx = 1) or y, from the differences of
/// neighbouring ones, in some rows of the image.
float jump_noise(const Image<float>& phase, int dx, int dy) {
  constexpr int kSamples = 400'000;
  std::vector<float> differences;
  const int stride = std::max(1, static_cast<int>(phase.pixels().size() / kSamples));
  for (int y = dy; y + dy < phase.height(); y += stride) {
    for (int x = dx; x + dx < phase.width(); ++x) {
      const float bend = phase(x - dx, y - dy) - 2.0F * phase(x, y) + phase(x + dx, y + dy);
      if (std::isnan(bend)) continue;
      differences.push_back(std::fabs(bend - 6.28318531F * std::round(bend / 6.28318531F)));
    }
  }
  if (differences.empty()) return 0.0F;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  // a - 2b + c has variance 6 sigma^2, a jump has 2 sigma^2.
  return *middle / 0.6745F / std::sqrt(3.0F);
}

Mask smooth_right(const Image<float>& phase, const SplitOptions& options) {
  const int width = phase.width();
  const auto row = static_cast<std::size_t>(width);
  const Limits limits{options.slack_rad + 5.0F * jump_noise(phase, 1, 0), options.max_jump_rad};
  Mask smooth(width, phase.height(), Unfilled{});
  parallel_rows(phase.height(), [&](int y) {
    std::vector<float> jump(row + 2, kMissing);  // one more at each end
    const float* from = phase.pixels().data() + static_cast<std::size_t>(y) * row;
    find_jumps(from, from + 1, width - 1, jump.data() + 1);
    judge_jumps(jump.data(), jump.data() + 1, jump.data() + 2, width, limits, &smooth(0, y));
  });
  return smooth;
}

Mask smooth_below(const Image<float>& phase, const SplitOptions& options) {
  constexpr int kBand = 32;  // rows that share their jumps
  const int width = phase.width();
  const int height = phase.height();
  const auto row = static_cast<std::size_t>(width);
  const Limits limits{options.slack_rad + 5.0F * jump_noise(phase, 0, 1), options.max_jump_rad};
  Mask smooth(width, height, Unfilled{});
  parallel_rows((height + kBand - 1) / kBand, [&](int band) {
    std::vector<float> before(row);
    std::vector<float> here(row);
    std::vector<float> behind(row);
    const auto jumps_below = [&](int y, std::vector<float>& jump) {
      if (y < 0 || y + 1 >= height) {
        std::fill(jump.begin(), jump.end(), kMissing);
        return;
      }
      const float* from = phase.pixels().data() + static_cast<std::size_t>(y) * row;
      find_jumps(from, from + row, width, jump.data());
    };
    jumps_below(band * kBand - 1, before);
    jumps_below(band * kBand, here);
    for (int y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y) {
      jumps_below(y + 1, behind);
      judge_jumps(before.data(), here.data(), behind.data(), width, limits, &smooth(0, y));
      std::swap(before, here);
      std::swap(here, behind);
    }
  });
  return smooth;
}

/// 1 where a pixel and its neighbour are both measured but their jump is not smooth.
FRANGIA_VECTORISED void mark_broken(const float* a,
                                    const float* b,
                                    const std::uint8_t* smooth,
                                    int count,
                                    std::uint8_t* broken_a,
                                    std::uint8_t* broken_b) {
  for (int x = 0; x < count; ++x) {
    const float both = a[x] + b[x];
    const auto cut = static_cast<std::uint8_t>((both == both ? 1 : 0) & (smooth[x] ^ 1));
    broken_a[x] = static_cast<std::uint8_t>(broken_a[x] | cut);
    if (broken_b != nullptr) broken_b[x] = static_cast<std::uint8_t>(broken_b[x] | cut);
  }
}

/// Pixels with a measured neighbour across a jump that is not smooth.
Mask broken_pixels(const Image<float>& phase, const Regions& regions) {
  const int width = phase.width();
  const int height = phase.height();
  Mask broken(width, height, 0);
  std::vector<std::uint8_t> right(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    const float* row = &phase.pixels()[static_cast<std::size_t>(y) * right.size()];
    std::fill(right.begin(), right.end(), std::uint8_t{0});
    mark_broken(row, row + 1, &regions.smooth_right(0, y), width - 1, right.data(), nullptr);
    for (int x = 0; x + 1 < width; ++x) {
      if (right[static_cast<std::size_t>(x)] != 0) broken(x, y) = broken(x + 1, y) = 1;
    }
    if (y + 1 == height) break;
    mark_broken(
        row, row + width, &regions.smooth_below(0, y), width, &broken(0, y), &broken(0, y + 1));
  }
  return broken;
}

FRANGIA_VECTORISED void widen(std::uint8_t* __restrict into,
                              const std::uint8_t* __restrict from,
                              std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    into[i] = into[i] > from[i] ? into[i] : from[i];
}

/// 1 within `radius` of a 1, both across and down: a square, one direction at a time.
void dilate(int radius, Mask& mask) {
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
  const Mask across = mask;
  parallel_rows(height, [&](int y) {
    for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v) {
      if (v != y) widen(&mask(0, y), &across(0, v), row);
    }
  });
}

struct Pixel {
  int x;
  int y;
};

/// Spreads labels over smooth jumps, breadth first, into pixels that `allowed` admits.
template <typename Allowed>
void spread(std::vector<Pixel>& front, Regions& regions, const Allowed& allowed) {
  auto& label = regions.label;
  for (std::size_t head = 0; head < front.size(); ++head) {
    const auto [x, y] = front[head];
    const auto visit = [&](int u, int v, bool smooth) {
      if (!smooth || label(u, v) >= 0 || !allowed(u, v)) return;
      label(u, v) = label(x, y);
      front.push_back({u, v});
    };
    if (x > 0) visit(x - 1, y, regions.smooth_right(x - 1, y) != 0);
    if (x + 1 < label.width()) visit(x + 1, y, regions.smooth_right(x, y) != 0);
    if (y > 0) visit(x, y - 1, regions.smooth_below(x, y - 1) != 0);
    if (y + 1 < label.height()) visit(x, y + 1, regions.smooth_below(x, y) != 0);
  }
}

/// Gives each connected set of admitted, unlabelled pixels the next label.
template <typename Allowed>
void label_all(Regions& regions, const Allowed& allowed) {
  const int height = regions.label.height();
  const PixelRuns all = find_runs(
      regions.label.width(),
      height,
      [&](int x, int y) { return regions.label(x, y) < 0 && allowed(x, y); },
      [&](int x, int y) { return regions.smooth_right(x, y) != 0; });
  RunForest forest(all.runs.size());
  for (int y = 1; y < height; ++y) {
    meet_row_above(all, y, [&](std::size_t a, std::size_t b, std::int32_t begin, std::int32_t end) {
      for (std::int32_t x = begin; x < end; ++x) {
        if (regions.smooth_below(x, y - 1) == 0) continue;
        forest.join(a, b, 0);
        return;
      }
    });
  }
  // A root is the first run of its set.
  std::vector<std::int32_t> label(all.runs.size());
  for (std::size_t i = 0; i < label.size(); ++i) {
    const std::size_t root = forest.root(i).run;
    label[i] = root == i ? regions.count++ : label[root];
  }
  parallel_rows(height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = all.first[row]; i < all.first[row + 1]; ++i) {
      std::fill(&regions.label(all.runs[i].begin, y),
                &regions.label(all.runs[i].begin, y) + (all.runs[i].end - all.runs[i].begin),
                label[i]);
    }
  });
}

/// Labelled pixels beside measured ones that have no label yet.
std::vector<Pixel> rims(const Image<float>& phase, const Image<std::int32_t>& label) {
  std::vector<Pixel> front;
  const auto waits = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < label.width() && y < label.height() && label(x, y) < 0 &&
           !std::isnan(phase(x, y));
  };
  for (int y = 0; y < label.height(); ++y) {
    for (int x = 0; x < label.width(); ++x) {
      if (label(x, y) < 0) continue;
      if (waits(x - 1, y) || waits(x + 1, y) || waits(x, y - 1) || waits(x, y + 1))
        front.push_back({x, y});
    }
  }
  return front;
}

}  // namespace

Regions split_regions(const WrappedPhase& wrapped, const SplitOptions& options) {
  const Image<float>& phase = wrapped.phase_rad;
  Regions regions{.label = Image<std::int32_t>(phase.width(), phase.height(), -1),
                  .count = 0,
                  .smooth_right = smooth_right(phase, options),
                  .smooth_below = smooth_below(phase, options)};
  Mask near_cut = broken_pixels(phase, regions);
  dilate(options.neck_radius_px, near_cut);
  const auto measured = [&](int x, int y) { return !std::isnan(phase(x, y)); };
  label_all(regions, [&](int x, int y) { return measured(x, y) && near_cut(x, y) == 0; });
  std::vector<Pixel> front = rims(phase, regions.label);
  spread(front, regions, measured);  // the rims around the cores
  label_all(regions, measured);      // what no core reaches
  return regions;
}

}  // namespace frangia
