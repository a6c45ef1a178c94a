#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// One place where the plane of light meets the object.
struct ProfilePoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< sub-pixel
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< rig frame
  double sigma_px = 0.0;                               ///< of the center, across the line
};

struct LaserProfileOptions {
  double min_sigmas =
      6.0;  ///< a peak stands out from its surroundings by this many sigmas of noise
  double min_contrast = 0.5;  ///< and by this share of the object's stray light
  int half_width_px = 12;     ///< how far around a peak belongs to it, at most
};

/// The object's profile in the plane of light: the center of each bright crossing of each row (or
/// column, where the line runs across the image), triangulated with the plane.
///
/// Light that spills beside the plane, and other light, light up the whole object, and its edges
/// look like lines. The fringe frames tell how bright each pixel is: the stray light that goes with
/// their mean is measured over the picture and taken away first.
///
/// units    px and mm, rig frame; `fringe_counts` the mean of the fringe frames, w x h
/// missing  a row without a crossing, or whose peak is saturated flat over more than 3 pixels
/// errors   Error(Input) when the rig has no plane of light, or the images differ in size
/// source   center of gravity above the surroundings, Fisher & Naidu 1996
[[nodiscard]] std::vector<ProfilePoint> laser_profile(const FrameStack& line,
                                                      const Image<float>& fringe_counts,
                                                      const Rig& rig,
                                                      const NoiseModel& noise,
                                                      const LaserProfileOptions& options = {});

}  // namespace frangia
