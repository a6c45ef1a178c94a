#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The standard uncertainty of measured points, along their viewing rays, that the covariance of
/// the rig's parameters causes.
///
/// Each independent change of the parameters displaces the triangulated points. The rigid motion
/// that fits the displacements of the measured volume best is removed first, because it moves the
/// part and leaves its shape and size as they are. The rest, along the ray, is smooth: it is
/// computed at the nodes of a coarse grid of pixels and depths, reduced to its few principal
/// components, and interpolated. Its root sum of squares is the uncertainty. Displacements across
/// the ray do not enter.
class CalibrationUncertainty {
 public:
  /// Linearizes the triangulation about the rig. `volume_mm` are points that represent the measured
  /// volume: some hundreds, on all surfaces and from all views. `camera` counts as in
  /// `rig_of_camera`; its points are those of its own ray and the projector's phase, or, where the
  /// projector is a label, the ray of the reference camera, or of the first other one.
  ///
  /// @units    mm, rig frame
  /// @missing  zero everywhere when the rig has no covariance or `volume_mm` is empty
  /// @source   GUM (JCGM 100:2008), 5.2; derivatives by central differences along the principal
  ///           axes of the covariance
  CalibrationUncertainty(const Rig& rig,
                         const Pattern& pattern,
                         std::span<const Eigen::Vector3d> volume_mm,
                         std::size_t camera = 0);

  /// Returns the standard uncertainty of the point that pixel (x, y) of the camera sees at a depth
  /// in its frame. Beyond the
  /// measured volume it is that at the volume's boundary.
  [[nodiscard]] double along_ray_mm(double x_px, double y_px, double depth_mm) const;

  /// Returns the uncertainty of all points of a grid; NaN where there is none. Empty without a
  /// covariance.
  [[nodiscard]] Image<float> along_rays_mm(const Image<float>& depth_mm) const;

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
  /// Displacements along the ray by each principal component; one column for each node.
  Eigen::MatrixXf along_ray_mm_;
};

}  // namespace frangia
