#pragma once

#include <span>

#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/phase_map.h"
#include "frangia/rig/projector.h"

namespace frangia {

struct TemporalUnwrapOptions {
  /// A pixel goes when the chance that one of its fringe orders is wrong is above this.
  double max_wrong_order = 1e-4;
  /// A coarse phase only chooses the fringe of a finer one, so it may be smoothed: the mean over
  /// the neighbours this far that agree with it within their noise. 0 leaves it as it is.
  int smooth_radius_px = 2;
};

/// Absolute phase of the finest fringes, each level lifted by the coarser one before it.
///
/// shape    coarse to fine, all w x h; the first absolute: one fringe or less over the field
/// units    rad
/// missing  a pixel missing at any level, or whose fringe order is in doubt, is NaN and says why
/// errors   Error(Input) when empty, not coarse to fine, or of different size
/// source   the paper's reference [36], Müller 1995
[[nodiscard]] AbsolutePhase unwrap_temporally(std::span<const WrappedPhase> coarse_to_fine,
                                              const Projector& projector,
                                              const TemporalUnwrapOptions& options = {});

/// The same from an absolute phase that is already there, such as one that the plane of light
/// fixed.
///
/// shape    `absolute` and every level w x h, coarse to fine
[[nodiscard]] AbsolutePhase unwrap_finer_levels(AbsolutePhase absolute,
                                                std::span<const WrappedPhase> finer,
                                                const TemporalUnwrapOptions& options = {});

}  // namespace frangia
