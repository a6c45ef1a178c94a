#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/pattern/pattern.h"
#include "frangia/range/measured_volume.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// One displacement for each independent change of the parameters.
using Displacements = Eigen::Matrix3Xd;

/// Triangulates points by rigs that differ from the true one by one change of the parameters each:
/// from a camera's ray and the projector's phase, or, where the projector is a label, from that ray
/// and the ray of a second camera.
class ChangedRigs {
 public:
  /// Takes one change for each column of the factor of the covariance, which must be known.
  /// `camera` counts as in `rig_of_camera`.
  ChangedRigs(const Rig& rig, const Pattern& pattern, std::size_t camera = 0);

  [[nodiscard]] Eigen::Index changes() const {
    return static_cast<Eigen::Index>(changed_.size() / 2);
  }

  /// The displacements of a measured point, both in the rig frame; NaN where a rig does not measure
  /// it.
  [[nodiscard]] Displacements displacements_of(const Eigen::Vector3d& point_mm) const;

 private:
  const Rig& rig_;
  const Pattern& pattern_;
  std::size_t camera_;
  std::vector<Rig> changed_;  ///< in pairs: by a step in either direction
};

/// The rays of cameras by rigs that differ from the true one by one change of the parameters each.
class ChangedRays {
 public:
  /// As `ChangedRigs`.
  explicit ChangedRays(const Rig& rig);

  /// The change of the signed distance between the rays of two cameras to a point, both of which
  /// see it, for each change of the parameters, mm. Cameras count as in `rig_of_camera`.
  [[nodiscard]] Eigen::VectorXd distances_of(const Eigen::Vector3d& point_mm,
                                             std::size_t first,
                                             std::size_t second) const;

 private:
  Rig rig_;
  std::vector<Rig> changed_;  ///< in pairs: by a step in either direction
};

/// A rigid motion for each change of the parameters, small enough to be linear: a translation and a
/// rotation vector about `center`, per `size_mm`.
struct RigidMotions {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double size_mm = 1.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions;

  [[nodiscard]] Eigen::Matrix<double, 3, 6> design(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d arm = (point - center) / size_mm;
    Eigen::Matrix<double, 3, 6> rows;
    rows.leftCols<3>().setIdentity();
    rows.rightCols<3>() << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
    return rows;
  }
};

/// The rigid motion of the rig frame, for each change, that the axis of a turntable follows: by
/// least squares, that by which the displaced views agree along the normals of shared places. What
/// they do not determine (everything, for a single view) fits the displacements of the points.
[[nodiscard]] RigidMotions fit_rigid(const MeasuredVolume& volume, const ChangedRigs& rigs);

}  // namespace frangia
