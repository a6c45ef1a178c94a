#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/fringe_order/fringe_order_candidates.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct FringeOrderCorrectionOptions {
  int patches_across = 32;     ///< a view is looked at in this many patches across
  double min_agreement = 0.5;  ///< share of a patch that others must confirm at its new place
  double min_agreement_hidden = 0.75;  ///< the same for a patch that lies behind what others saw
  double max_current_agreement = 0.1;  ///< and at most confirm where it is
  double tolerance = 0.06;  ///< of the depth between two fringes: how near counts as agreeing
};

/// Moves patches that lie a whole number of fringes off to where the other views saw the surface.
///
/// Unwrapping in space cannot see a depth step that happens to be a whole number of fringes high
/// all along its edge. Other angles do: nothing is confirmed where the patch lies, and all of it
/// one or more fringes away. Returns how many points moved.
///
/// missing  pixels where a moved patch meets one that stayed are dropped as mixed edges
[[nodiscard]] std::size_t correct_fringe_orders(ViewStore& views,
                                                const FringeOptics& optics,
                                                const FringeOrderCorrectionOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
