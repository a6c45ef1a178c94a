#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/board/measure_light.h"
#include "frangia/core/run.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A pixel of the laser line on an artifact.
struct LinePixel {
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();  ///< in the camera image
  double sigma_px = 0.0;                                ///< standard deviation across the line
};

/// An artifact at one angle of the turntable.
struct ArtifactView {
  std::string name;              ///< of the view's folder, for messages
  double angle_rad = 0.0;        ///< stated angle of the turntable
  std::vector<LightSite> sites;  ///< on the artifact
  std::vector<int> surface;      ///< of each site: 0, or 1 for the second ball
  std::vector<LinePixel> line;   ///< of the laser sheet on surface 0; empty without one
};

/// All views of an artifact that stands on the turntable.
struct ArtifactCapture {
  Artifact artifact;                ///< plate or balls
  std::vector<ArtifactView> views;  ///< that show it
  /// Approximate surfaces in the rig frame at table angle 0: normal and distance of the plate, or
  /// the center of each ball and 0.
  std::vector<Eigen::Vector4d> surfaces;
  std::vector<std::string> left_out{};  ///< folders of the views without it
};

/// What is known beforehand, and limits of the adjustment.
struct ArtifactSolveOptions {
  /// Distance of camera and projector; it gives the scale where no ball does.
  std::optional<double> baseline_mm;
  /// Standard deviation of the table's angles to begin with; it is then estimated. Rotary stages
  /// have 0.01 to 0.1 degrees.
  double angle_sigma_rad = 1e-3;
  int max_iterations = 200;  ///< of the solver, for each round
};

/// The rig that fits the artifacts.
struct ArtifactSolution {
  Rig rig;  ///< projector, turntable and, with lines, laser sheet; the camera where it is uncertain
  std::vector<std::vector<double>> angle_errors_rad;  ///< by capture and view; 0 for the first view
  std::vector<std::vector<Eigen::Vector4d>> surfaces;  ///< by capture, as `ArtifactCapture`
  std::vector<std::vector<double>> diameters_mm;       ///< by capture and ball
  double light_rms = 0.0;         ///< of the residuals, projector px or rad of psi
  double light_noise = 1.0;       ///< residuals over their standard deviations by phase
  double line_rms_mm = 0.0;       ///< of the laser line from the sheet; 0: no sheet was fitted
  double angle_sigma_rad = 0.0;   ///< standard deviation of the table's angles, estimated
  std::vector<std::string> held;  ///< directions that the data leaves open, in words
  std::vector<std::string> parameters;  ///< names of the rows of `covariance`
  Eigen::MatrixXd covariance;           ///< of `rig_parameter_names`; 0 for those that are held
  double axis_sigma_rad = 0.0;          ///< of the direction of the table's axis, the larger of two
  double point_sigma_mm = 0.0;          ///< of its place, the larger of two
};

/// Estimates projector and turntable from plates and balls on the turntable, in one
/// bundle adjustment over all captures: the light at each site is predicted from the intersection
/// of the camera's ray with the artifact, at the table's angle, and compared with the phase.
///
/// An angular projector is estimated whole, with its pitch and those terms of its wavefront that
/// the start has or the residuals call for. A digital projector's intrinsics, and those of the
/// camera, are adjusted within the covariance of `start.calibration`, or held where it has none.
/// The turntable's angles are estimated with a prior. The laser sheet is then fitted to its line on
/// the artifacts.
///
/// @units    mm, rad, px
/// @missing  a site with one direction enters by it alone
/// @errors   Error(Input) when the views span less than 20 degrees or are fewer than three, the
///           start has no turntable, or the data leaves a parameter open; Error(Numeric) when the
///           adjustment fails
/// @source   least squares by Ceres with Huber's loss; the standard deviations of phases and angles
///           are scaled to their residuals
[[nodiscard]] ArtifactSolution solve_artifacts(std::span<const ArtifactCapture> captures,
                                               const Rig& start,
                                               const ArtifactSolveOptions& options = {},
                                               const Run& run = {});

}  // namespace frangia
