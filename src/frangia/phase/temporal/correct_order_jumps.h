#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "frangia/phase/wrap/phase_map.h"
#include "frangia/phase/wrap/smooth_jumps.h"

namespace frangia {

/// The wrapped phases of the coarser patterns at some pixels.
///
/// @shape    one index y * width + x for each pixel; one map for each coarser pattern, each one row
///           of these pixels
using CoarsePhases = std::function<std::vector<WrappedPhase>(std::span<const std::uint32_t>)>;

/// When the fringe orders of a region are taken as wrong.
struct OrderJumpOptions {
  JumpOptions smooth;  ///< limits of a smooth difference of the wrapped phase
  /// Largest share of the measured pixels whose order may be wrong. Where there are more, something
  /// else is wrong, such as the order of the frames, and nothing is changed.
  double max_share = 0.1;
};

/// Numbers of pixels whose fringe order was wrong.
struct OrderJumpResult {
  std::size_t corrected = 0;  ///< moved by whole fringes
  std::size_t discarded = 0;  ///< without a phase now, marked UncertainOrder
};

/// Corrects regions whose fringe order is wrong as a whole. Light from other parts of the surface
/// can shift coarse fringes by more than half a fine one; inside such a region the patterns then
/// seem to agree. At its border the order jumps, while the fine phase and the coarse phases go on
/// smoothly. At a real step that is a whole number of fringes high, the coarse phases have a step,
/// too.
///
/// `coarse` is called only if there are such borders.
///
/// @shape    `phase` w x h, that of the finest pattern
/// @units    rad
/// @missing  a discarded pixel is NaN; a pair of pixels with a missing coarse phase decides nothing
OrderJumpResult correct_order_jumps(const CoarsePhases& coarse,
                                    AbsolutePhase& phase,
                                    const OrderJumpOptions& options = {});

}  // namespace frangia
