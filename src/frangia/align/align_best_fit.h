#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/uncertainty/pose_uncertainty.h"

namespace frangia {

/// Limits of a best fit. Lengths of 0 are chosen from the size of the reference.
struct BestFitOptions {
  double tolerance_mm = 0.0;   ///< deviation of the part that still counts as overlap; 0: 0.2 % of
                               ///< the size of the reference
  double least_overlap = 0.3;  ///< below, the reference is of another part
  double reference_unit_mm = 1.0;  ///< by which the file of the reference was read, for messages
  /// A pose near the right one, such as that of `align_to_points`; none: any pose is tried.
  std::optional<Eigen::Isometry3d> from;
  std::optional<std::size_t> start;  ///< index of the pose to choose among `AlignmentPose`s
  std::size_t rotations = 800;       ///< evenly spread, that the search starts from
  std::size_t fine_samples = 30000;  ///< of the mesh in the last fit
  std::uint64_t seed = 1;            ///< of the samples

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// A pose of the mesh in which it fits the reference.
struct AlignmentPose {
  Eigen::Isometry3d reference_from_mesh = Eigen::Isometry3d::Identity();  ///< the pose
  double overlap = 0.0;  ///< share of the measured area within 3 sigma and the tolerance
  double rms_mm = 0.0;   ///< of the distances of that area
  int iterations = 0;    ///< of the last fit
  /// Of the pose, from the residuals of the last fit; zero for a pose that was not fitted.
  PoseUncertainty uncertainty;
};

/// The result of an alignment.
struct Alignment {
  AlignmentPose pose;  ///< the pose that was chosen
  /// Poses that fit alike, which symmetries of the part cannot explain away as free directions; the
  /// best first. One entry: the pose is unique.
  std::vector<AlignmentPose> alternatives;
  /// Motions that the shape does not determine, such as "rotation about (0, 0, 1) through (0, 0,
  /// 40)". The pose keeps an arbitrary value along them.
  std::vector<std::string> free_directions;
};

/// Finds the pose in which a mesh fits a reference best, from any start.
///
/// The search tries evenly spread rotations, with translations that put points with like normals
/// onto each other, and refines the best of these by the iterative-closest-point method. The last
/// fit minimizes point-to-plane distances, weighted by sigma, with Tukey's biweight. Synthesized
/// triangles are left out. `from` replaces the search, and chooses among poses that fit alike.
///
/// @units    mm
/// @errors   Error(Input) when less than `least_overlap` of the mesh lies on the reference, saying
///           whether its mirror image would fit, and when another unit clearly fits better;
///           Error(Numeric) that lists the
///           poses when several fit alike and no `start` is chosen; Error(Cancelled)
/// @source   Besl & McKay 1992; Chen & Medioni 1991; rotations: Alexa 2022
[[nodiscard]] Alignment align_best_fit(const Mesh& mesh,
                                       const RayScene& reference,
                                       const BestFitOptions& options = {},
                                       const Run& run = {});

/// Measures how a mesh fits a reference in a given pose.
///
/// @errors   as align_best_fit, for a mesh without measured triangles
[[nodiscard]] AlignmentPose assess_pose(const Mesh& mesh,
                                        const RayScene& reference,
                                        const Eigen::Isometry3d& reference_from_mesh,
                                        const BestFitOptions& options = {},
                                        const Run& run = {});

/// Refuses a mesh that clearly lies on the reference in a given pose only after both have the same
/// unit: when one of them is scaled by 10, 25.4, 304.8 or 1000.
///
/// @errors   Error(Input) that states the factor and the overlaps with and without it
void refuse_unit_of_pose(const Mesh& mesh,
                         const RayScene& reference,
                         const Eigen::Isometry3d& reference_from_mesh,
                         const BestFitOptions& options = {},
                         const Run& run = {});

}  // namespace frangia
