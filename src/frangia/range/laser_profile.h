#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// One measured point of the laser line.
struct ProfilePoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< sub-pixel
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< rig frame
  double sigma_px = 0.0;  ///< standard deviation of `pixel`, across the line
};

/// Criteria that a peak must meet to be the laser line.
struct LaserProfileOptions {
  double min_contrast = 0.5;  ///< minimum height of a peak, as a share of the object's stray light
  int half_width_px = 12;     ///< maximum distance of a peak's pixels from its brightest one
  double threshold = 0.2;     ///< share of a peak's height; pixels below do not enter its centre
};

/// Locates the laser line in each row to sub-pixel accuracy and triangulates it with the laser
/// sheet. A line that runs across the image is located in each column instead.
///
/// Stray light of the laser and ambient light illuminate the whole object, and edges of the object
/// then resemble lines. The part of the frame that is proportional to the mean of the fringe frames
/// is estimated over the image and subtracted first.
///
/// @shape    `fringe_counts`: the mean of the fringe frames, w x h
/// @units    px and mm, rig frame
/// @missing  a row without a peak gives no point, nor does a peak with too many saturated pixels
/// @errors   Error(Input) when the rig has no laser sheet or the images differ in size
/// @source   center of gravity above the background, Fisher & Naidu 1996
[[nodiscard]] std::vector<ProfilePoint> laser_profile(const FrameStack& line,
                                                      const Image<float>& fringe_counts,
                                                      const Rig& rig,
                                                      const NoiseModel& noise,
                                                      const LaserProfileOptions& options = {});

}  // namespace frangia
