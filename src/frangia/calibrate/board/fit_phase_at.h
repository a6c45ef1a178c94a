#pragma once

#include <limits>
#include <span>

#include <Eigen/Core>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Window of a local phase fit.
struct PhaseFitOptions {
  int radius_px = 15;   ///< of the square window about the point
  int min_pixels = 30;  ///< fewer measured ones give no value
};

/// Absolute phase at one point and its standard deviation; NaN where it cannot be fitted.
struct PhaseAt {
  double phase_rad = std::numeric_limits<double>::quiet_NaN();    ///< value of the fit
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();    ///< scaled to the residuals
  Eigen::Vector2d gradient_rad_per_px = Eigen::Vector2d::Zero();  ///< by x and y of the image
};

/// Absolute phase at a point between pixels: the value of a quadratic that is fitted to the pixels
/// around it, weighted by their sigma and robust against outliers.
///
/// @shape    both images w x h
/// @units    rad; px
/// @missing  NaN where too few pixels of the window are measured
/// @source   least squares with Tukey's biweight
[[nodiscard]] PhaseAt fit_phase_at(const Image<float>& phase_rad,
                                   const Image<float>& sigma_rad,
                                   const Eigen::Vector2d& point_px,
                                   const PhaseFitOptions& options = {});

/// How far the frames of a fringe pattern are from a sinusoid of the pattern's shifts: the residual
/// of the fit, as a standard deviation of one frame, relative to the modulation; medians over the
/// bright pixels around the points. 0.01 to 0.03 is camera noise, a display gamma of 2.2 gives 0.3
/// with four frames, and frames in a wrong order give 1.4.
///
/// @missing  NaN for fewer than four frames, which leave no residual, or without bright pixels
[[nodiscard]] double measure_fringe_misfit(const FrameStack& stack,
                                           std::span<const BoardPoint> points);

}  // namespace frangia
