#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/uncertainty/pose_uncertainty.h"

namespace frangia {

/// A sample of the measured surface.
struct MeasuredSample {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;
  double sigma_mm = 0.0;  ///< combined; 0 when unknown
};

/// Samples the measured triangles of a mesh evenly over their area, in random order: the first n
/// samples are spread over the whole surface, too.
///
/// @errors   Error(Input) when no triangle is measured
[[nodiscard]] std::vector<MeasuredSample> measured_samples(const Mesh& mesh,
                                                           std::size_t count,
                                                           std::uint64_t seed);

/// A point of the reference and its normal.
struct Foot {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;
};

/// Finds the foot of a point within a distance.
using FindFoot =
    std::function<std::optional<Foot>(const Eigen::Vector3d& point_mm, double reach_mm)>;

/// The feet on a mesh, exactly.
[[nodiscard]] FindFoot exact_feet(const RayScene& reference);

/// How a fit proceeds.
struct PoseFitOptions {
  double gate_mm = 0.0;        ///< of the first iteration; required
  double least_gate_mm = 0.0;  ///< the gate never closes further
  double least_cosine = 0.3;   ///< between the normals of a sample and its foot
  int max_iterations = 30;
};

/// A fitted pose.
struct PoseFit {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  int iterations = 0;
  double gate_mm = 0.0;  ///< of the last iteration
  Eigen::Matrix<double, 6, 6> hessian =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< at the end,
                                            ///< of rotations about `center` (first three, times
                                            ///< `lever_mm`) and translations
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double lever_mm = 1.0;
};

/// Moves samples onto a reference by point-to-plane steps, with Tukey's biweight and weights by
/// sigma.
[[nodiscard]] PoseFit fit_pose(std::span<const MeasuredSample> samples,
                               const FindFoot& find_foot,
                               const Eigen::Isometry3d& start,
                               const PoseFitOptions& options,
                               const Run& run);

/// The motion by a twist: rotations times the lever about the center, and translations.
[[nodiscard]] Eigen::Isometry3d motion_of(const Eigen::Matrix<double, 6, 1>& twist,
                                          const Eigen::Vector3d& center,
                                          double lever_mm);

/// The covariance of a fitted pose from the residuals of its samples. Residuals of neighbouring
/// samples are alike, so the spread of the gradients of 64 compact blocks is propagated. Directions
/// that the samples hardly determine are held and have no variance.
///
/// @source   Liang & Zeger 1986 (clustered errors)
[[nodiscard]] PoseUncertainty pose_covariance(std::span<const MeasuredSample> samples,
                                              const FindFoot& find_foot,
                                              const PoseFit& fit);

}  // namespace frangia
