#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/range/depth_agreement.h"
#include "frangia/range/measured_volume.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The standard uncertainty of the measured surface, along the viewing rays, that the covariance of
/// the rig's parameters causes.
///
/// Each independent change of the parameters displaces the triangulated points. A rigid motion in
/// the rig frame is removed first, because the axis of the turntable moves along with it: the one
/// by which the views agree best where they share surface, and, as far as these do not tell, the
/// one that fits the displacements of the measured volume. The rest, along the ray, is smooth: it
/// is computed at the nodes of a coarse grid of pixels and depths, reduced to its few principal
/// components, and interpolated. The root sum of squares of what it moves the surface by, along the
/// ray, is the uncertainty.
class CalibrationUncertainty {
 public:
  /// Linearizes the triangulation about the rig. `camera` counts as in
  /// `rig_of_camera`; its points are those of its own ray and the projector's phase, or, where the
  /// projector is a label, the ray of the reference camera, or of the first other one.
  ///
  /// @units    mm, rig frame
  /// @missing  zero everywhere when the rig has no covariance or the volume is empty
  /// @source   GUM (JCGM 100:2008), 5.2; derivatives by central differences along the principal
  ///           axes of the covariance
  CalibrationUncertainty(const Rig& rig,
                         const Pattern& pattern,
                         const MeasuredVolume& volume,
                         std::size_t camera = 0);

  /// Returns the standard uncertainty of a point of this camera's frame along its ray. Beyond the
  /// measured volume it is that at the volume's boundary.
  [[nodiscard]] double along_ray_mm(const Eigen::Vector3d& point_mm,
                                    const Eigen::Vector2d& pixel) const;

  /// Returns the uncertainty of all points of a grid, NaN where there is none: the distance along
  /// the ray by which the surface moves there, so that displacements across the ray count on
  /// surface that is inclined to it. Empty without a covariance.
  ///
  /// @shape    rays: as the grid; x and y at a depth of 1, in the camera's frame
  [[nodiscard]] Image<float> along_rays_mm(const Image<float>& depth_mm,
                                           const Image<Eigen::Vector2f>& rays) const;

 private:
  static constexpr std::array<int, 3> kNodes{17, 17, 9};  ///< along x, y and depth
  [[nodiscard]] static Eigen::Array3d node_counts() { return {kNodes[0], kNodes[1], kNodes[2]}; }
  [[nodiscard]] static Eigen::Index node(int x, int y, int z) {
    return (z * kNodes[1] + y) * kNodes[0] + x;
  }
  /// Node coordinates of a pixel and a depth, within the grid.
  [[nodiscard]] Eigen::Array3d place_of(double x_px, double y_px, double depth_mm) const;

  Eigen::Array3d low_ = Eigen::Array3d::Zero();   ///< x px, y px, depth mm of the first node
  Eigen::Array3d step_ = Eigen::Array3d::Ones();  ///< distance of nodes
  /// Displacements in the camera's frame: a row for each principal component; three columns, x, y,
  /// z, for each node.
  Eigen::MatrixXf displacements_mm_;
};

/// What the covariance of the rig adds to the difference between the points of two directions of
/// fringes, along the ray of the reference camera.
///
/// @missing  empty where the rig states no uncertainty of its calibration. Without a covariance it
///           is that of two points of `point_sigma_mm`
/// @source   GUM (JCGM 100:2008), 5.2
[[nodiscard]] DifferenceUncertainty between_directions(const Rig& rig,
                                                       const Pattern& first,
                                                       const Pattern& second);

/// The same for the points of two cameras, along the ray of camera `own`; with a projector that is
/// a label, for the distance of their rays. Cameras count as in `rig_of_camera`; the points are in
/// the frame of camera `own`.
[[nodiscard]] DifferenceUncertainty between_cameras(const Rig& rig,
                                                    const Pattern& pattern,
                                                    std::size_t own,
                                                    std::size_t other);

}  // namespace frangia
