#pragma once

#include <algorithm>
#include <cmath>

namespace frangia {

/// How depth changes across a place, and as far on either side of it.
struct DepthChange {
  float jump_mm;
  float before_mm;
  float after_mm;
};

/// Whether depth jumps by more than `least_mm` beyond what its sides expect, and by more than
/// either of them changes: a slope does the same on both sides, a crease as much as one. False
/// where one is missing.
[[nodiscard]] inline bool is_depth_step(const DepthChange& change, float least_mm) {
  const auto& [jump, before, after] = change;
  const float excess = std::abs(jump - 0.5F * (before + after));
  return excess > least_mm && std::abs(jump) > std::max(std::abs(before), std::abs(after));
}

}  // namespace frangia
