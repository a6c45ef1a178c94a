#pragma once

#include "frangia/pattern/pattern.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// The range of absolute phases over the illuminated field.
struct PhaseRange {
  double min_rad = 0.0;  ///< smallest phase in the field
  double max_rad = 0.0;  ///< largest phase in the field
  /// Difference of the largest and the smallest phase.
  [[nodiscard]] double width_rad() const { return max_rad - min_rad; }
  /// Phase in the middle of the range.
  [[nodiscard]] double center_rad() const { return 0.5 * (min_rad + max_rad); }
};

/// Returns the range of a pattern's absolute phase over the projector's field.
[[nodiscard]] PhaseRange phase_range(const Pattern& pattern, const Projector& projector);

/// Returns whether the field spans at most one fringe, so that the wrapped phase is the absolute
/// phase.
[[nodiscard]] bool is_absolute(const Pattern& pattern, const Projector& projector);

}  // namespace frangia
