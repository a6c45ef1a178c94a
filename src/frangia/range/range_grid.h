#pragma once

#include "frangia/core/image.h"
#include "frangia/core/missing.h"

namespace frangia {

/// One pixel of a range grid; see `RangeGrid` for the meaning of the values.
struct RangePixel {
  int x = 0;                       ///< column
  int y = 0;                       ///< row
  float depth_mm = 0.0F;           ///< NaN: no point
  float sigma_mm = 0.0F;           ///< NaN: no point
  float phase_rad = kMissing;      ///< NaN: not measured by fringes
  float systematic_mm = kMissing;  ///< NaN: no point, or no systematic part is known
};

/// The surface as one camera sees it: a point for each pixel. The point of pixel (x, y) is
/// `depth_mm * (ray.x, ray.y, 1)`, with `ray` from `rays_of(model)`.
///
/// @shape    all images w x h; `phase_rad` and `systematic_mm` may be empty
/// @units    mm, rig frame; rad
/// @missing  a pixel without a point is NaN in all images; a point that was not measured by
///           fringes, such as one of another scanner, is NaN in `phase_rad`. An empty `phase_rad`
///           stands for an image of NaN, an empty `systematic_mm` for no known systematic part
struct RangeGrid {
  Image<float> depth_mm;  ///< z, along the optical axis
  Image<float> sigma_mm;  ///< noise: standard deviation of the point along its viewing ray
  /// Absolute phase of the pattern that the point was triangulated with: the wrapped phase plus
  /// 2 pi times the fringe order.
  Image<float> phase_rad = {};
  /// Systematic standard uncertainty of the point along its viewing ray.
  Image<float> systematic_mm = {};
  /// Share of the variance of `systematic_mm`, 0 to 1, by causes whose error at a point of the
  /// surface differs from view to view; see `AbsolutePhase::differing_share`.
  float differing_share = 0.0F;

  /// Returns the values of pixel (x, y).
  [[nodiscard]] RangePixel pixel(int x, int y) const {
    return {x,
            y,
            depth_mm(x, y),
            sigma_mm(x, y),
            phase_rad.empty() ? kMissing : phase_rad(x, y),
            systematic_mm.empty() ? kMissing : systematic_mm(x, y)};
  }
  /// Stores the values of a pixel, except for those of which the grid has no image.
  void set(const RangePixel& pixel) {
    depth_mm(pixel.x, pixel.y) = pixel.depth_mm;
    sigma_mm(pixel.x, pixel.y) = pixel.sigma_mm;
    if (!phase_rad.empty()) phase_rad(pixel.x, pixel.y) = pixel.phase_rad;
    if (!systematic_mm.empty()) systematic_mm(pixel.x, pixel.y) = pixel.systematic_mm;
  }
  /// Sets all values of pixel (x, y) to NaN.
  void remove(int x, int y) { set({x, y, kMissing, kMissing, kMissing}); }
};

}  // namespace frangia
