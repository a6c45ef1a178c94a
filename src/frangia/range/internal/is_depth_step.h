#pragma once

#include <algorithm>
#include <cmath>

namespace frangia {

/// Change of depth across a place and over the same distance on either side of it.
struct DepthChange {
  float jump_mm;
  float before_mm;
  float after_mm;
};

/// Whether the jump exceeds the mean change of both sides by more than `least_mm`, and exceeds the
/// change of each side. The second condition excludes slopes, where all three changes are equal,
/// and creases, where the jump equals the change of one side.
///
/// @missing  false where a change is missing
[[nodiscard]] inline bool is_depth_step(const DepthChange& change, float least_mm) {
  const auto& [jump, before, after] = change;
  const float excess = std::abs(jump - 0.5F * (before + after));
  return excess > least_mm && std::abs(jump) > std::max(std::abs(before), std::abs(after));
}

}  // namespace frangia
