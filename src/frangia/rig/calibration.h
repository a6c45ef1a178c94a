#pragma once

#include <string>
#include <utility>
#include <vector>

#include "frangia/rig/rig_covariance.h"

namespace frangia {

/// How a rig was calibrated and how uncertain the result is: `[calibration]` of rig.toml.
struct Calibration {
  std::string date;               ///< day of the calibration, as 2026-11-23
  std::string board;              ///< kind of the board, as in scan.toml
  int poses = 0;                  ///< poses of the board that were used
  double camera_rms_px = 0.0;     ///< reprojection error of the camera, all points counted
  double projector_rms_px = 0.0;  ///< reprojection error of the projector, all points counted
  /// Standard uncertainty of a point at `distance_mm` that the uncertainty of the calibration
  /// causes, as the root mean square over the volume in which the board was.
  double point_sigma_mm = 0.0;
  double distance_mm = 0.0;  ///< mean distance of the board from the camera
  /// Names and standard deviations of the estimated parameters, in the order of the covariance.
  std::vector<std::pair<std::string, double>> sigma;
  std::string covariance_file;  ///< CSV file beside rig.toml with the covariance; may be empty
  RigCovariance covariance;     ///< what that file holds; empty without one
};

}  // namespace frangia
