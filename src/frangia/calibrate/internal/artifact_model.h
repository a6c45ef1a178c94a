#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/artifact/calibrate_artifacts.h"
#include "frangia/calibrate/artifact/solve_artifacts.h"
#include "frangia/calibrate/solve/solve_camera.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Parameters of the adjustment to artifacts: flat blocks of numbers.
struct ArtifactParameters {
  using Surface = std::array<double, 4>;

  std::array<double, 9> camera{};     ///< fx fy/fx cx cy k1 k2 p1 p2 k3
  std::array<double, 9> projector{};  ///< likewise, of a digital one
  std::array<double, 6> pose{};       ///< projector_from_camera: rotation vector, translation
  double pitch_scale = 1.0;           ///< of an angular projector
  std::array<double, Wavefront::kTerms> wavefront{};  ///< likewise, see Wavefront
  std::array<double, 4> table{};  ///< two tilts and two shifts across the starting axis
  /// By capture and view.
  std::vector<std::vector<double>> angle_errors;
  /// By capture: two tilts and the offset of a plate, or center and relative diameter of each ball.
  std::vector<std::vector<Surface>> surfaces;
};

/// Standard deviations by which those of the observations are multiplied, and that of the angles.
struct ArtifactNoise {
  double light = 1.0;
  double angle_rad = 1e-3;
};

/// The constant part of the adjustment.
struct ArtifactProblem {
  std::span<const ArtifactCapture> captures;
  Rig start;
  ArtifactSolveOptions options;
  /// Square root of the information about camera, projector, pose and pitch, one column for each of
  /// their 25 parameters; no rows where nothing is known.
  Eigen::MatrixXd prior;
  std::array<double, 25> prior_mean{};
  bool free_camera = false;      ///< the prior determines it
  bool free_intrinsics = false;  ///< of a digital projector, likewise
  bool has_scale = false;        ///< by a ball
  /// Terms of the wavefront that are estimated, of an angular projector.
  std::array<bool, Wavefront::kTerms> free_wavefront{};
};

/// The start as parameters.
[[nodiscard]] ArtifactParameters artifact_start(const ArtifactProblem& problem);

/// The rig that the parameters stand for.
[[nodiscard]] Rig artifact_rig(const ArtifactProblem& problem,
                               const ArtifactParameters& parameters);

/// A plate's normal and distance, or a ball's center and 0.
[[nodiscard]] Eigen::Vector4d artifact_surface(const ArtifactProblem& problem,
                                               std::size_t capture,
                                               std::size_t surface,
                                               const ArtifactParameters& parameters);

/// Minimizes all residuals in place; whether it ended at a usable state.
///
/// @errors   Error(Cancelled) when a stop is requested
bool adjust_artifacts(const ArtifactProblem& problem,
                      const ArtifactNoise& noise,
                      ArtifactParameters& parameters,
                      const Run& run);

/// Residuals of sites in their standard deviations as measured, and in their own units.
struct ArtifactResiduals {
  std::vector<double> light_sigmas, light;
  std::size_t missed = 0;  ///< sites whose ray misses the surface
};

[[nodiscard]] ArtifactResiduals artifact_residuals(const ArtifactProblem& problem,
                                                   const ArtifactParameters& parameters);

/// Where the pixels of the laser line meet the artifacts.
///
/// @units    mm, rig frame
[[nodiscard]] std::vector<Eigen::Vector3d> artifact_line_points(
    const ArtifactProblem& problem, const ArtifactParameters& parameters);

/// Jacobian of the weighted residuals at the optimum, by the parameters that are estimated.
struct ArtifactLinearization {
  Eigen::MatrixXd normal;          ///< sum of the squares of the Jacobian
  Eigen::VectorXd gradient;        ///< of half the sum of squares
  std::vector<std::string> names;  ///< of its columns; see solve_artifacts.cpp
};

[[nodiscard]] ArtifactLinearization linearize_artifacts(const ArtifactProblem& problem,
                                                        const ArtifactNoise& noise,
                                                        const ArtifactParameters& parameters);

/// Measures all poses of a screen.
///
/// @errors   Error(Input) when a direction is missing or a pattern is not one of the screen
[[nodiscard]] std::vector<ScreenView> measure_screen(const Scan& scan, const Run& run);

/// Finds a plate in all views of a scan, by the phase alone, and its approximate surface by the
/// rig.
///
/// @errors   Error(Input) when no view shows a plane
[[nodiscard]] ArtifactCapture measure_plate(const Scan& scan,
                                            const Rig& rig,
                                            const CalibrateArtifactsOptions& options,
                                            const Run& run);

/// Finds balls in all views of a scan by a rig that is right but for its scale.
///
/// @errors   Error(Input) when no view shows all balls
[[nodiscard]] ArtifactCapture measure_balls(const Scan& scan, const Rig& rig, const Run& run);

/// The points of sites as the rig triangulates them.
///
/// @units    mm, rig frame
/// @missing  NaN where the light of vertical fringes is missing
[[nodiscard]] std::vector<Eigen::Vector3d> site_points(const std::vector<LightSite>& sites,
                                                       const Rig& rig);

/// The pose of the table at an angle, relative to that at angle 0: rig_from_rig.
[[nodiscard]] Eigen::Isometry3d table_turn(const Rig& rig, double angle_rad);

/// Signed distance of a measured point from the artifact on which it lies.
struct ArtifactDistance {
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();
  double distance_mm = 0.0;  ///< above 0 outside of a ball, or beyond a plate along its normal
};

/// The distances of the sites of one view of a capture, triangulated with the calibrated rig, from
/// the artifact as it was found, turned by the angle of the table and its error.
///
/// @missing  a site that is not measured is left out
[[nodiscard]] std::vector<ArtifactDistance> artifact_distances(const ArtifactCalibration& result,
                                                               std::size_t capture,
                                                               std::size_t view);

/// Root mean square; 0 without a distance.
[[nodiscard]] double rms_mm(const std::vector<ArtifactDistance>& distances);

}  // namespace frangia
