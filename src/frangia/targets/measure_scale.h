#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "frangia/rig/target_set.h"
#include "frangia/targets/match_targets.h"

namespace frangia {

/// What known distances between targets say of the scale of a scan.
struct TargetScale {
  double factor = 1.0;                       ///< known over measured distance
  double sigma = 0.0;                        ///< standard uncertainty of the factor
  std::size_t distances = 0;                 ///< that were measured
  double chi_squared = 0.0;                  ///< of the distances after the scale is fitted
  std::vector<KnownTargetDistance> missing;  ///< with a target that no view saw

  /// Whether the distances contradict each other by more than their uncertainties explain.
  [[nodiscard]] bool contradicts() const;
};

/// Fits the scale to the known distances by least squares.
///
/// @missing  none when no known distance was measured
[[nodiscard]] std::optional<TargetScale> measure_scale(std::span<const Target> targets,
                                                       const TargetSet& set);

}  // namespace frangia
