#include "frangia/phase/split_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

float wrapped_jump(float a, float b) {
  const float difference = b - a;
  return difference - 6.28318531F * std::round(difference / 6.28318531F);
}

/// Wrapped jumps along x (dx = 1, dy = 0) or y; NaN where one end is missing.
Image<float> jumps(const Image<float>& phase, int dx, int dy) {
  Image<float> out(phase.width(), phase.height(), kMissing);
  parallel_rows(phase.height() - dy, [&](int y) {
    for (int x = 0; x + dx < phase.width(); ++x)
      out(x, y) = wrapped_jump(phase(x, y), phase(x + dx, y + dy));
  });
  return out;
}

/// How far a jump lies outside those before and behind it; NaN when neither is known.
float departure(const Image<float>& jump, int x, int y, int dx, int dy) {
  const float here = jump(x, y);
  const bool has_before = x >= dx && y >= dy;
  const bool has_behind = x + dx < jump.width() && y + dy < jump.height();
  const float before = has_before ? jump(x - dx, y - dy) : kMissing;
  const float behind = has_behind ? jump(x + dx, y + dy) : kMissing;
  // fmin and fmax pass over the one that is missing.
  const float low = std::fmin(before, behind);
  const float high = std::fmax(before, behind);
  return std::fmax(0.0F, std::fmax(low - here, here - high));
}

/// Standard deviation of the jumps' noise: from the differences of neighbouring ones.
float jump_noise(const Image<float>& jump, int dx, int dy) {
  std::vector<float> differences;
  const int stride = std::max(1, static_cast<int>(jump.pixels().size() / 400'000));
  for (int y = dy; y < jump.height(); y += stride) {
    for (int x = dx; x < jump.width(); ++x) {
      const float difference = jump(x, y) - jump(x - dx, y - dy);
      if (!std::isnan(difference)) differences.push_back(std::abs(difference));
    }
  }
  if (differences.empty()) return 0.0F;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  // a - 2b + c has variance 6 sigma^2, a jump has 2 sigma^2.
  return *middle / 0.6745F / std::sqrt(3.0F);
}

Image<std::uint8_t> smooth_jumps(const Image<float>& phase,
                                 int dx,
                                 int dy,
                                 const SplitOptions& options) {
  const Image<float> jump = jumps(phase, dx, dy);
  const float limit = options.slack_rad + 5.0F * jump_noise(jump, dx, dy);
  Image<std::uint8_t> smooth(phase.width(), phase.height(), 0);
  parallel_rows(phase.height(), [&](int y) {
    for (int x = 0; x < phase.width(); ++x) {
      const float here = jump(x, y);
      if (std::isnan(here) || std::abs(here) > options.max_jump_rad) continue;
      const float away = departure(jump, x, y, dx, dy);
      smooth(x, y) = away <= limit ? 1 : 0;  // a lone pair has no departure: fmax passes the NaN
    }
  });
  return smooth;
}

/// Pixels with a measured neighbour across a jump that is not smooth.
Image<std::uint8_t> broken_pixels(const Image<float>& phase, const Regions& regions) {
  Image<std::uint8_t> broken(phase.width(), phase.height(), 0);
  for (int y = 0; y < phase.height(); ++y) {
    for (int x = 0; x < phase.width(); ++x) {
      if (std::isnan(phase(x, y))) continue;
      if (x + 1 < phase.width() && !std::isnan(phase(x + 1, y)) &&
          regions.smooth_right(x, y) == 0) {
        broken(x, y) = broken(x + 1, y) = 1;
      }
      if (y + 1 < phase.height() && !std::isnan(phase(x, y + 1)) &&
          regions.smooth_below(x, y) == 0) {
        broken(x, y) = broken(x, y + 1) = 1;
      }
    }
  }
  return broken;
}

/// Steps of a chess king from each pixel to the nearest broken one, up to `limit`.
Image<std::int32_t> distance_to(const Image<std::uint8_t>& broken, int limit) {
  const int width = broken.width();
  const int height = broken.height();
  Image<std::int32_t> distance(width, height, limit);
  const auto relax = [&](int x, int y, int u, int v) {
    if (u < 0 || v < 0 || u >= width || v >= height) return;
    distance(x, y) = std::min(distance(x, y), distance(u, v) + 1);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (broken(x, y) != 0) distance(x, y) = 0;
      relax(x, y, x - 1, y);
      for (int u = x - 1; u <= x + 1; ++u)
        relax(x, y, u, y - 1);
    }
  }
  for (int y = height - 1; y >= 0; --y) {
    for (int x = width - 1; x >= 0; --x) {
      relax(x, y, x + 1, y);
      for (int u = x - 1; u <= x + 1; ++u)
        relax(x, y, u, y + 1);
    }
  }
  return distance;
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

/// Gives each connected set of admitted pixels the next label; returns them all, label by label.
template <typename Allowed>
std::vector<Pixel> label_all(Regions& regions, const Allowed& allowed) {
  std::vector<Pixel> labelled;
  std::vector<Pixel> front;
  for (int y = 0; y < regions.label.height(); ++y) {
    for (int x = 0; x < regions.label.width(); ++x) {
      if (regions.label(x, y) >= 0 || !allowed(x, y)) continue;
      regions.label(x, y) = regions.count++;
      front.assign(1, {x, y});
      spread(front, regions, allowed);
      labelled.insert(labelled.end(), front.begin(), front.end());
    }
  }
  return labelled;
}

}  // namespace

Regions split_regions(const WrappedPhase& wrapped, const SplitOptions& options) {
  const Image<float>& phase = wrapped.phase_rad;
  Regions regions{.label = Image<std::int32_t>(phase.width(), phase.height(), -1),
                  .count = 0,
                  .smooth_right = smooth_jumps(phase, 1, 0, options),
                  .smooth_below = smooth_jumps(phase, 0, 1, options)};
  const int limit = options.neck_radius_px + 1;
  const auto distance = distance_to(broken_pixels(phase, regions), limit);
  const auto measured = [&](int x, int y) { return !std::isnan(phase(x, y)); };
  std::vector<Pixel> front =
      label_all(regions, [&](int x, int y) { return measured(x, y) && distance(x, y) == limit; });
  spread(front, regions, measured);                 // the rims around the cores
  static_cast<void>(label_all(regions, measured));  // what no core reaches
  return regions;
}

}  // namespace frangia
