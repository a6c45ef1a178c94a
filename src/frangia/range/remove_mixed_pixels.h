#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// Criteria of pixels that see two surfaces.
struct MixedPixelOptions {
  double max_incidence_deg = 82.0;  ///< a surface at a larger angle of incidence is a depth step
  int min_patch_px = 12;            ///< connected patches of fewer points are removed
  double min_step_px = 2.5;         ///< minimum depth step, in lateral pixel distances, plus noise
  double min_step_sigmas = 4.0;     ///< minimum depth step in sigmas of its noise
  int min_dark_neighbors = 3;       ///< of a silhouette's pixel, among 8; fewer are defects
  double blur_px = 0.0;             ///< sigma of the blur of the image, see `ImageBlur`
};

/// Removes the points of pixels that receive light from two surfaces, or from a surface and the
/// background.
///
/// The pixels on both sides of a depth step may mix light of both surfaces: those next to it, and
/// with a blurred image all that receive more than 1 % of their light from beyond it. The outermost
/// pixel of a silhouette receives light from only a part of its area, so its point does not lie on
/// the ray through its centre; with a blurred image those with more than 5 % from beyond it are as
/// far off. Patches too small to be a surface are removed last.
///
/// @shape    w x h; the result holds the removed pixels row by row, with their former values: some
///          see a single surface, see `recover_edge_pixels`
/// @missing  a removed pixel is NaN in `range` and MixedPixel in `status`
/// @errors   Error(Input) when range, rays and status differ in size
std::vector<RangePixel> remove_mixed_pixels(RangeGrid& range,
                                            const Image<Eigen::Vector2f>& rays,
                                            Image<PixelStatus>& status,
                                            const MixedPixelOptions& options = {});

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
