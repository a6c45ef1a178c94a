#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/registration/view_motions.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Views with a free rigid pose each; the pose of view 0 is held. The maps must outlive it.
struct FreePoseBundle {
  std::span<const SurfelMap> maps;
  std::vector<std::vector<SurfelMap::Surfel>> surfels;  ///< those that are compared, by view
  std::vector<Eigen::Isometry3d> rig_from_world;
  FastCameraModel model;
  ViewPairs pairs{};  ///< the views that are compared
};

/// Normal equations of all point-to-plane distances between views.
///
/// @shape    unknowns: three shifts (mm) and three rotations (rad) about the world's origin for
///          each of views 1, 2, ...
struct FreePoseSums {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  /// As `hessian`, of the whole way by which a motion moves the points of the pairs against each
  /// other, not only of that along the normals.
  Eigen::MatrixXd ways;
  std::vector<double> distances_mm;  ///< absolute, of all pairs within the gate
  std::vector<float> over_sigma;     ///< the same over the standard deviations of the pairs
  std::size_t matched = 0;           ///< surfels that lie on a surface of another view
  std::size_t surfels = 0;
};

/// Derivatives of `normal.dot(point)` by three shifts and three rotations of the point.
[[nodiscard]] Eigen::Matrix<double, 6, 1> point_to_plane_jacobian(const Eigen::Vector3d& normal,
                                                                  const Eigen::Vector3d& point);

/// Compares the surfels of each view with those of its paired views, within `gate_mm`.
[[nodiscard]] FreePoseSums sum_free_poses(const FreePoseBundle& bundle, double gate_mm);

/// Moves the views 1, 2, ... in the world by a step in the unknowns.
void apply_update(FreePoseBundle& bundle, const Eigen::VectorXd& step);

/// The equations of all pairs and of the given poses, about the centres of the views.
///
/// @shape    unknowns: for each of views 1, 2, ... the shift of its centre and its rotation about
///          it, as the way (mm) at its arm
struct RestedEquations {
  Eigen::MatrixXd to;  ///< unknowns of the bundle by those of this
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
};

/// Takes from the equations the motions that leave the surfaces where they are, along which noise
/// of normals would move the views, and adds the given poses, on which these motions then rest.
///
/// @units    `prior_mm`: standard deviation of the given poses, as the way of a view's points
[[nodiscard]] RestedEquations rest_on_given(const FreePoseBundle& bundle,
                                            const FreePoseSums& sums,
                                            std::span<const Eigen::Isometry3d> given,
                                            double prior_mm);

/// How far given poses are from those of the bundle by the motions that the pairs determine.
struct DeterminedOffsets {
  double rms_mm = 0.0;  ///< of the shifts of the views' centres or of the rotations at their arms,
                        ///< whichever is larger
  double sigma_mm = 0.0;  ///< what the pairs themselves leave of these motions, root mean square
  std::size_t count = 0;  ///< of the motions
};

[[nodiscard]] DeterminedOffsets determined_offsets(const FreePoseBundle& bundle,
                                                   const FreePoseSums& sums,
                                                   std::span<const Eigen::Isometry3d> given);

/// How the poses of free views may be wrong by what their pairs leave open, in independent changes
/// of one standard deviation.
///
/// @shape    one for each view; that of view 0, whose pose is held, is 0
/// @units    `prior_mm`: standard deviation of the given poses, as the way of a view's points
[[nodiscard]] ViewMotions motions_of_free_poses(const FreePoseBundle& bundle,
                                                const FreePoseSums& sums,
                                                double prior_mm);

}  // namespace frangia
