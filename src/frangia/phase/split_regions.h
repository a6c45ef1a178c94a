#pragma once

#include <cstdint>

#include "frangia/phase/phase_map.h"
#include "frangia/phase/smooth_jumps.h"

namespace frangia {

struct SplitOptions {
  JumpOptions jumps;
  /// Regions that only hang together through a neck of twice this width beside a cut are two: a
  /// depth step whose height varies looks smooth where it passes a whole number of fringes.
  int neck_radius_px = 12;
};

/// Regions within which the phase is smooth, so that unwrapping cannot go wrong there.
struct Regions {
  Image<std::int32_t> label;  ///< 0, 1, ...; -1 where not measured
  int count = 0;
  Image<std::uint8_t> smooth_right;  ///< the jump to the right-hand neighbour is smooth
  Image<std::uint8_t> smooth_below;  ///< the jump to the neighbour below is smooth
};

/// Cuts the phase wherever it may hide a step of more than half a fringe. It cuts too much rather
/// than too little: `join_regions` mends what is safe.
[[nodiscard]] Regions split_regions(const WrappedPhase& phase, const SplitOptions& options = {});

}  // namespace frangia
