#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// Which removed pixels at edges are recovered.
struct EdgePixelOptions {
  int depth_px = 3;  ///< passes; each recovers pixels next to those of the one before
  double max_incidence_deg = 82.0;  ///< a surface at a larger angle of incidence is a depth step
  /// Minimum step in front of a rejected pixel, in lateral pixel distances plus noise. Lower than
  /// in `MixedPixelOptions`: next to a removed pixel a step is more likely than on a closed
  /// surface.
  double min_step_px = 1.5;
  double min_step_sigmas = 8.0;  ///< minimum step in sigmas of the pixel's noise
};

/// Selects those pixels removed by `remove_mixed_pixels` that see a single surface.
///
/// A pixel is recovered when it lies on the extrapolation of the surface next to it and is as
/// bright as that surface, see `continues_surface`. When two recovered surfaces become neighbours
/// across a depth step that is not steeper than a slope may be, fusion would connect them: the
/// pixel behind the step is then left out.
///
/// @shape    `reliable` and `rays` w x h; the result is in the order of `removed`
/// @errors   Error(Input) when grid and rays differ in size
[[nodiscard]] std::vector<RangePixel> recover_edge_pixels(const RangeGrid& reliable,
                                                          const Image<Eigen::Vector2f>& rays,
                                                          const std::vector<RangePixel>& removed,
                                                          const EdgePixelOptions& options = {});

}  // namespace frangia
