#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/fringe_order/fringe_order_candidates.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct FringeOrderCorrectionOptions {
  int patches_across = 32;  ///< patches that a view is divided into, across
  /// Minimum share of a patch's points that other views must confirm at the corrected order.
  double min_agreement = 0.5;
  /// The same for a patch that other views do not contradict because it lies behind their surface.
  double min_agreement_hidden = 0.75;
  /// Maximum share of a patch's points that other views may confirm at the present order.
  double max_current_agreement = 0.1;
  double tolerance = 0.06;  ///< distance that counts as agreement, per fringe spacing in depth
};

/// Corrects the fringe orders of patches whose surface the other views measured a whole number of
/// fringes away. Returns the number of corrected points.
///
/// Spatial unwrapping cannot detect a depth step that is a whole number of fringes high all along
/// its edge. Other views can: they confirm no point of the patch at its present order and most of
/// them at another one.
///
/// missing  mixed pixels at the border of a corrected patch are removed; so are small patches that
///          violate free space, and all edge pixels of a corrected view
[[nodiscard]] std::size_t correct_fringe_orders(ViewStore& views,
                                                const FringeOptics& optics,
                                                const FringeOrderCorrectionOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
