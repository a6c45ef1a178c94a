#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/phase/phase_map.h"
#include "frangia/range/range_grid.h"

namespace frangia {

struct MixedPixelOptions {
  /// A surface seen at a flatter angle than this counts as a depth step.
  double max_incidence_deg = 82.0;
  /// A patch of fewer points than this that hangs on no other is no surface.
  int min_patch_px = 12;
};

/// Drops the points that a pixel made of two surfaces, or of one surface and the dark.
///
/// At a depth step the pixels on both sides may hold light of both surfaces, so they go. On a
/// silhouette against the dark the outermost pixel holds light of its covered part only, which is
/// not its centre, so it goes too. What is left in patches too small to be a surface goes last.
/// Dropped pixels are marked MixedPixel in `status`. Returns them, in order, as they were: some may
/// see one surface after all, see `recover_edge_pixels`.
std::vector<RangePixel> remove_mixed_pixels(RangeGrid& range,
                                            const Image<Eigen::Vector2f>& rays,
                                            Image<PixelStatus>& status,
                                            const MixedPixelOptions& options = {});

}  // namespace frangia
