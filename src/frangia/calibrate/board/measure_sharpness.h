#pragma once

#include <span>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/core/image.h"

namespace frangia {

/// Standard deviation of the blur of the edges at the corners of a board, as if it were Gaussian;
/// median over all corners, NaN without corners.
///
/// @shape    image of the mean intensity; `reach_px` is half the side of the window about a corner
/// @units    px; a sharp image has 0.4 to 1
[[nodiscard]] double measure_blur_px(const Image<float>& counts,
                                     std::span<const BoardPoint> points,
                                     int reach_px);

/// How sharp an image is as a whole, whatever it shows.
struct ImageSharpness {
  double blur_px = 0.0;   ///< of its steepest edges, as if they were as high as `contrast`
  double contrast = 0.0;  ///< between its 5th and 95th percentile, counts
};

/// Measures an image in which no board is found, to compare it with others in which one is.
///
/// @units    px, counts
[[nodiscard]] ImageSharpness measure_image_sharpness(const Image<float>& counts);

/// Largest distance by which the corners of a board lie elsewhere in `counts` than in `points`; the
/// median over all corners of each coordinate, so that noise averages out.
///
/// @units    px
[[nodiscard]] double measure_motion_px(const Image<float>& counts,
                                       std::span<const BoardPoint> points,
                                       int reach_px);

/// How far `counts` looks like `reference` at the corners of a board: the correlation coefficient
/// of the pixels about each, median over all. Near 1 for the same pose, near 0 or below for
/// another; NaN without corners.
[[nodiscard]] double measure_likeness(const Image<float>& counts,
                                      const Image<float>& reference,
                                      std::span<const BoardPoint> points,
                                      int reach_px);

}  // namespace frangia
