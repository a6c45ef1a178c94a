#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/registration/internal/table_state.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Derivatives of the distance of a pair by the unknowns that it depends on.
struct PairJacobian {
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();   ///< mm/rad
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< mm/mm
  double angle_to = 0.0;                            ///< mm/rad, angle of the view with the target
  double angle_from = 0.0;                          ///< mm/rad, angle of the view with the point
  /// Three shifts and three rotations of the part pose in the setup of either view.
  Eigen::Matrix<double, 6, 1> setup_to = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> setup_from = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Takes points from the rig frame at one view to the rig frame at another: back to table angle 0,
/// to the part pose of the other setup, and on to the other angle.
class ViewTransfer {
 public:
  ViewTransfer(const TableState& state, std::size_t from, std::size_t to);

  [[nodiscard]] const Eigen::Matrix3d& rotation() const { return rotation_; }
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point) const {
    return center_ + forth_ * in_other_setup(point);
  }
  /// Derivatives of `normal.dot(apply(point))` by a step in the unknowns.
  [[nodiscard]] PairJacobian jacobian(const Eigen::Vector3d& normal,
                                      const Eigen::Vector3d& point) const;

 private:
  /// `point` relative to the table's point, at table angle 0, in the other setup.
  [[nodiscard]] Eigen::Vector3d in_other_setup(const Eigen::Vector3d& point) const {
    return across_setups_ * (back_ * (point - center_) + center_) - center_;
  }

  Eigen::Matrix3d back_, forth_;
  Eigen::Isometry3d across_setups_;
  Eigen::Matrix3d rotation_;  ///< of all three
  Eigen::Vector3d center_;
  Eigen::Vector3d axis_;
  Eigen::Matrix<double, 3, 2> sideways_;
};

/// Triangulates the points of all views by another rig. Each stays on its camera pixel and on the
/// absolute phase that the first rig shows there.
///
/// @missing  a point that the other rig does not measure is removed; there are no systematic parts
[[nodiscard]] ViewStore retriangulate_views(const ViewStore& views,
                                            const Pattern& pattern,
                                            const Rig& from,
                                            const Rig& to,
                                            const Run& run = {});

/// The same for one view.
[[nodiscard]] View retriangulate(View view, const Pattern& pattern, const Rig& from, const Rig& to);

}  // namespace frangia
