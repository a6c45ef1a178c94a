#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/fringe_order/resolve_by_views.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// All shares refer to a patch's compared points.
struct FringeOrderCorrectionOptions {
  std::size_t min_patch_px = 4;  ///< patches with fewer measured pixels are left unchanged
  int max_samples = 48;          ///< maximum number of compared points of a patch
  double min_agreement = 0.5;    ///< minimum score of the corrected order
  double max_runner_up = 0.5;    ///< maximum score of the second best order, per score of the best
  double tolerance = 0.06;       ///< distance that counts as agreement, per fringe spacing in depth
  /// Criteria of the mixed pixels that are removed from a corrected view. `reconstruct` replaces
  /// them by those of its own options.
  MixedPixelOptions mixed_pixels{};
};

/// Corrects the fringe orders of patches whose surface the other views measured a whole number of
/// fringes away. Returns the number of corrected points.
///
/// Spatial unwrapping cannot detect a depth step that is a whole number of fringes high all along
/// its edge. Other views can: they confirm no point of the patch at its present order and most of
/// them at another one. The points are recomputed from the phase that the range grid keeps.
///
/// @missing  views without phase are left unchanged; mixed pixels at the border of a corrected
///          patch are removed, as are refined patches that violate free space and all edge pixels
///          of a corrected view
[[nodiscard]] std::size_t correct_fringe_orders(ViewStore& views,
                                                const FringeOptics& optics,
                                                const FringeOrderCorrectionOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
