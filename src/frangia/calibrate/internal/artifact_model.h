#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/artifact/solve_artifacts.h"
#include "frangia/core/run.h"

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

}  // namespace frangia
