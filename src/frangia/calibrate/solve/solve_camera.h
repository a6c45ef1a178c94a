#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/calibrate/board/measure_light.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/core/run.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// One pose of the screen.
struct ScreenView {
  std::string name;  ///< of the view's folder, for messages
  std::vector<LightSite>
      points;  ///< in pixels of the screen, evenly over the image, where the screen is seen
};

/// Intrinsics of a camera, with their uncertainty.
struct CameraSolution {
  CameraModel camera;                                 ///< found intrinsics
  std::vector<Eigen::Isometry3d> camera_from_screen;  ///< one a view, mm
  ResidualSummary residuals;                          ///< of all points, px of the camera
  std::vector<ResidualSummary> by_view;               ///< one a view
  /// Observed minus predicted pixel of each point, by view; in the order of the points.
  std::vector<std::vector<Eigen::Vector2d>> residuals_px;
  double bend_mm = 0.0;                 ///< largest estimated deviation of the screen from a plane
  std::vector<std::string> terms;       ///< model terms that the data supports, in words
  std::vector<std::string> held;        ///< optional terms that the data does not support
  std::vector<std::string> parameters;  ///< names of the rows of `covariance`: "camera.focal_px"
  Eigen::MatrixXd covariance;           ///< of the intrinsics, as `RigSolution::covariance`
};

/// Estimates the intrinsics of a camera from poses of a screen whose pixels are known by phase. The
/// residuals are weighted by the standard deviation of the phase; the order of the distortion and
/// the bend of the screen are chosen by evidence.
///
/// @units    mm, px
/// @errors   Error(Input) for fewer than three views, a view with too few points or a mirrored
///           screen, and poses that are all parallel; Error(Numeric) when the adjustment fails
/// @source   Zhang 2000; Schmalz, Forster & Angelopoulou 2011, Camera calibration: active versus
///           passive targets
[[nodiscard]] CameraSolution solve_camera(const Screen& screen,
                                          std::span<const ScreenView> views,
                                          int width_px,
                                          int height_px,
                                          const RigSolveOptions& options = {},
                                          const Run& run = {});

}  // namespace frangia
