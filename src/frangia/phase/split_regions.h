#pragma once

#include <cstdint>

#include "frangia/phase/phase_map.h"
#include "frangia/phase/smooth_jumps.h"

namespace frangia {

struct SplitOptions {
  JumpOptions jumps;
  /// A connection narrower than twice this radius beside a cut does not join two regions. A depth
  /// step of varying height looks smooth where it crosses a whole number of fringes.
  int neck_radius_px = 12;
};

/// Regions within which the phase is smooth and unwrapping is unambiguous.
struct Regions {
  Image<std::int32_t> label;  ///< 0, 1, ...; -1 where not measured
  int count = 0;
  Image<std::uint8_t> smooth_right;  ///< as `smooth_right` of smooth_jumps.h
  Image<std::uint8_t> smooth_below;  ///< as `smooth_below` of smooth_jumps.h
};

/// Cuts the phase wherever it may hide a step of more than half a fringe. The cut is conservative;
/// `join_regions` rejoins regions where that is safe.
///
/// shape    w x h in and out
/// missing  NaN pixels get the label -1
[[nodiscard]] Regions split_regions(const WrappedPhase& wrapped, const SplitOptions& options = {});

}  // namespace frangia
