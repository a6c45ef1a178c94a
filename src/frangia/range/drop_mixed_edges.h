#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/phase/phase_map.h"
#include "frangia/range/range_grid.h"

namespace frangia {

struct EdgeOptions {
  /// A surface seen at a flatter angle than this counts as a depth step.
  double max_incidence_deg = 82.0;
  /// A patch of fewer points than this that hangs on no other is no surface.
  int min_patch_px = 12;
  int give_back_px = 0;  ///< how far into the dropped ones those that are no mixture are given back
};

/// Drops the points that a pixel made of two surfaces, or of one surface and the dark.
///
/// At a depth step the pixels on both sides may hold light of both surfaces, so they go. On a
/// silhouette against the dark the outermost pixel holds light of its covered part only, which is
/// not its centre, so it goes too. What is left in patches too small to be a surface goes last.
/// With `give_back_px`, those that lie where the surface beside them leads are given back, see
/// `continues_surface`: they see one surface with all of their square.
/// Dropped pixels are marked MixedEdge in `fate`. Returns how many.
std::size_t drop_mixed_edges(RangeGrid& range,
                             const Image<Eigen::Vector2f>& rays,
                             Image<PixelFate>& fate,
                             const EdgeOptions& options = {});

}  // namespace frangia
