#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/solve/calibrate_rig.h"

namespace frangia {

/// A residual at a place of an image.
struct ResidualArrow {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();      ///< where the point was found, px
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();  ///< in the unit of the map
};

/// Residuals over the image of one device.
struct ResidualMap {
  std::string title;                  ///< "Camera", "Projector", or the name of a further camera
  int width = 0;                      ///< of the image, px
  int height = 0;                     ///< of the image, px
  double rms = 0.0;                   ///< of all residuals
  const char* unit = "px";            ///< of the residuals
  std::vector<ResidualArrow> arrows;  ///< of all poses
};

/// What one pose of a board contributed to a calibration.
struct PoseResiduals {
  std::string name;               ///< folder of the view
  double camera_rms_px = 0.0;     ///< reprojection error of the reference camera
  double projector_rms_px = 0.0;  ///< of the projector; 0 without one
  double distance_mm = 0.0;       ///< of the board from the camera
  double tilt_rad = 0.0;          ///< of the board from facing the camera
  double change_mm = 0.0;         ///< of the measured points when this pose is left out
  bool is_outlier = false;        ///< its error is far above that of the others
};

/// The residuals of a calibration over the images of its devices: the reference camera, the
/// projector as that camera reads it, further cameras.
[[nodiscard]] std::vector<ResidualMap> residual_maps(const RigCalibration& result);

/// The poses of a calibration in the order of its views. Outliers are those that `calibrate_rig`
/// warns of with the same options.
[[nodiscard]] std::vector<PoseResiduals> pose_residuals(const RigCalibration& result);

}  // namespace frangia
