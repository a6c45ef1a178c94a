#pragma once

#include <array>

#include <Eigen/Core>

#include "frangia/pattern/pattern.h"
#include "frangia/range/measured_volume.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// How the independent changes of a rig's parameters, of one standard deviation each, displace the
/// points that it measures. The rigid motion by which the views agree best is removed, as in
/// `CalibrationUncertainty`.
///
/// The field is smooth: it is computed at the nodes of a coarse grid of pixels and depths, reduced
/// to its principal components, and interpolated.
class RigChangeField {
 public:
  /// Linearizes the triangulation about the rig.
  ///
  /// @units    mm, rig frame
  /// @missing  no components when the rig has no covariance or the volume is empty
  /// @source   GUM (JCGM 100:2008), 5.2
  RigChangeField(const Rig& rig, const Pattern& pattern, const MeasuredVolume& volume);

  /// Number of independent components.
  [[nodiscard]] Eigen::Index components() const { return components_; }

  /// The displacement of a measured point by each component: three rows, one column for each.
  /// Beyond the measured volume it is that at the volume's boundary.
  [[nodiscard]] Eigen::Matrix3Xf at(const Eigen::Vector3d& point_mm) const;

 private:
  static constexpr std::array<int, 3> kNodes{13, 13, 7};  ///< along x, y and depth

  const Rig& rig_;
  Eigen::Index components_ = 0;
  Eigen::Array3d low_ = Eigen::Array3d::Zero();   ///< x px, y px, depth mm of the first node
  Eigen::Array3d step_ = Eigen::Array3d::Ones();  ///< distance of nodes
  Eigen::MatrixXf values_;  ///< a row for each component; three columns, x, y, z, for each node
};

}  // namespace frangia
