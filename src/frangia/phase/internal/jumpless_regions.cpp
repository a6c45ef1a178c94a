#include "frangia/phase/internal/jumpless_regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "frangia/core/angles.h"

namespace frangia {

JumplessRegions find_jumpless_regions(const Image<float>& phase_rad) {
  const int width = phase_rad.width();
  const int height = phase_rad.height();
  JumplessRegions out;
  out.label.assign(phase_rad.pixels().size(), -1);
  std::vector<std::uint32_t> open;
  for (std::size_t seed = 0; seed < out.label.size(); ++seed) {
    if (out.label[seed] >= 0 || std::isnan(phase_rad.pixels()[seed])) continue;
    const auto region = static_cast<std::int32_t>(out.size.size());
    out.size.push_back(0);
    out.label[seed] = region;
    open.push_back(static_cast<std::uint32_t>(seed));
    while (!open.empty()) {
      const auto index = static_cast<int>(open.back());
      open.pop_back();
      ++out.size.back();
      const int x = index % width;
      const int y = index / width;
      const auto visit = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= width || v >= height) return;
        const int other = v * width + u;
        std::int32_t& label = out.label[static_cast<std::size_t>(other)];
        if (label >= 0 || !(std::abs(phase_rad(u, v) - phase_rad(x, y)) <= kPiF)) return;
        label = region;
        open.push_back(static_cast<std::uint32_t>(other));
      };
      visit(x - 1, y);
      visit(x + 1, y);
      visit(x, y - 1);
      visit(x, y + 1);
    }
  }
  std::vector<std::int32_t> order(out.size.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return out.size[static_cast<std::size_t>(a)] > out.size[static_cast<std::size_t>(b)];
  });
  std::vector<std::int32_t> rank(order.size());
  std::vector<std::size_t> sorted(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
    sorted[i] = out.size[static_cast<std::size_t>(order[i])];
  }
  for (std::int32_t& label : out.label)
    if (label >= 0) label = rank[static_cast<std::size_t>(label)];
  out.size = std::move(sorted);
  return out;
}

bool is_split(std::span<const double> places) {
  constexpr std::size_t kBeside = 5;  // pixels on both sides that belong to the surface
  constexpr double kSameSide = 0.2;   // of the field
  constexpr double kAtTheEnd = 0.05;  // of the field: what two neighbouring pixels span
  for (std::size_t x = kBeside; x + kBeside + 1 < places.size(); ++x) {
    const double jump = std::abs(places[x] - places[x + 1]);
    if (std::abs(jump - 1.0) < kAtTheEnd && std::abs(places[x] - places[x - kBeside]) < kSameSide &&
        std::abs(places[x + 1] - places[x + 1 + kBeside]) < kSameSide)
      return true;
  }
  return false;
}

}  // namespace frangia
