#pragma once

#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/board/fit_phase_at.h"
#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Where the light comes from that a camera pixel sees, by the phase of each fringe direction:
/// pixels of a projector or screen, or the nominal angle psi of an angular projector in rad.
struct LightSite {
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();  ///< in the camera image
  /// By vertical and by horizontal fringes; NaN where a direction is not measured.
  Eigen::Vector2d light = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();  ///< standard deviation of `light`
  /// Derivative of `light` with respect to the camera pixel, on the surface around the site.
  Eigen::Matrix2d by_camera = Eigen::Matrix2d::Zero();
};

/// How the light is measured on a grid of camera pixels.
struct MeasureLightOptions {
  int step_px = 16;  ///< distance of sites, along rows and columns
  PhaseFitOptions fit{.radius_px = 6, .min_pixels = 60};  ///< phase at each site
  DecodeOptions decode;                                   ///< from frames to absolute phase
  /// Takes the order of fringes without an absolute phase from the laser line; the display must
  /// then be a calibrated rig.
  bool use_laser_line = false;
};

/// Measures where the light comes from at each site of a grid over the camera image, from the
/// phases of the fringe directions that the frames hold.
///
/// @shape    row by row, the same sites for every view; `stacks` as read_frames returns them
/// @units    pixels of the digital projector or screen in `display.projector`, or nominal psi in
///           rad
/// @missing  NaN at a site or in a direction without a phase
/// @errors   Error(Input) when a direction has no absolute phase, or as `decode_view`
[[nodiscard]] std::vector<LightSite> measure_light(std::span<const FrameStack> stacks,
                                                   const Rig& display,
                                                   const MeasureLightOptions& options = {},
                                                   const Run& run = {});

}  // namespace frangia
