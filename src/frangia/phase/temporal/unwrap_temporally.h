#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "frangia/pattern/fringe_sequence.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Reliability limit and smoothing of temporal unwrapping.
struct TemporalUnwrapOptions {
  /// Largest probability that one of a pixel's fringe orders is wrong; a pixel above it is
  /// discarded.
  double max_wrong_order = 1e-4;
  /// Radius of the mean filter on coarse levels, px; 0 for none. A coarse phase only selects the
  /// fringe of a finer one, so smoothing it loses no detail. Only neighbours that agree within
  /// their noise contribute.
  int smooth_radius_px = 2;
};

/// Computes the absolute phase of the finest fringes; each level is unwrapped by the next coarser
/// one.
///
/// @shape    coarse to fine, all w x h; the first has at most one fringe over the field
/// @units    rad
/// @missing  a pixel missing at any level, or with an uncertain fringe order, is NaN; its status
///          states the reason
/// @errors   Error(Input) when empty, not coarse to fine, or of different size
/// @source   the paper's reference [36], Müller 1995
[[nodiscard]] AbsolutePhase unwrap_temporally(std::span<const WrappedPhase> coarse_to_fine,
                                              const Projector& projector,
                                              const TemporalUnwrapOptions& options = {});

/// Computes the same as `unwrap_temporally` and uses the memory of the maps for the result.
///
/// @errors   as `unwrap_temporally`
[[nodiscard]] AbsolutePhase unwrap_temporally_in_place(std::vector<WrappedPhase>&& coarse_to_fine,
                                                       const Projector& projector,
                                                       const TemporalUnwrapOptions& options = {});

/// Unwraps finer levels by an existing absolute phase, for example one that the laser sheet fixed.
///
/// @shape    `absolute` and every level w x h, coarse to fine
/// @units    rad
/// @missing  as `unwrap_temporally`
/// @errors   Error(Input) when not coarse to fine, or of different size
[[nodiscard]] AbsolutePhase unwrap_finer_levels(AbsolutePhase absolute,
                                                std::span<const WrappedPhase> finer,
                                                const TemporalUnwrapOptions& options = {});

/// One level of hierarchical unwrapping: a map or the beat of two maps.
struct UnwrapLevel {
  std::size_t map = 0;    ///< index of the map
  int subtracted = -1;    ///< index of the subtracted map; -1 for none
  double per_unit = 0.0;  ///< fringes per degree or projector pixel
};

/// Finds the levels from one fringe over the field to the finest map. Each level is the finest that
/// is safe for noise `sigma_rad` in every map; empty when the maps do not determine an absolute
/// phase.
///
/// @shape    patterns coarse to fine
/// @units    rad
[[nodiscard]] std::vector<UnwrapLevel> find_unwrap_levels(std::span<const Pattern> patterns,
                                                          const Projector& projector,
                                                          double sigma_rad = 0.05);

/// Returns whether every level has a probability of a wrong order below `max_wrong_order` for noise
/// `sigma_rad` in every map.
[[nodiscard]] bool is_safe(std::span<const UnwrapLevel> levels,
                           double sigma_rad,
                           double max_wrong_order);

}  // namespace frangia
