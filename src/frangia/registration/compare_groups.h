#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Geometry>

#include "frangia/registration/view_group.h"

namespace frangia {

/// Fit of one group to another in one pose.
///
/// @shape    motions: three shifts (mm), then three rotations about `center_mm`, each as the arc
///          (mm) at a distance of `arm_mm`
struct GroupFit {
  std::size_t agree = 0;       ///< points of either group on the surface that the other measured
  std::size_t violations = 0;  ///< points of either group in front of what the other measured
  double overlap = 0.0;        ///< share of the smaller group's points that agree
  double residual_mm = 0.0;    ///< median distance of the points that agree
  double smallest_eigenvalue = 0.0;  ///< of the information of a motion, a share of the points'
                                     ///< weight; 0 when one group slides or turns on the other
  double second_eigenvalue = 0.0;    ///< the next larger one
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< of `from`, in the frame of `to`
  double arm_mm = 1.0;  ///< root mean square distance of the points of `from` from their center
  /// Sum of w J^T J over the points that agree, w by Tukey's biweight.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  /// Sum of w J^T r over the same points, mm.
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 2> weakest_directions =
      Eigen::Matrix<double, 6, 2>::Zero();  ///< the two motions that are determined worst

  /// `step` as a motion of `from`, in the frame of `to`.
  [[nodiscard]] Eigen::Isometry3d motion(const Eigen::Matrix<double, 6, 1>& step) const;
  /// The axis, in the frame of `to`, if the worst determined motion is a turn about one.
  [[nodiscard]] std::optional<Eigen::ParametrizedLine<double, 3>> weakest_axis() const;
  /// Share of the compared points that violate free space; 1 when none agrees.
  [[nodiscard]] double free_space_violation() const {
    return agree == 0 ? 1.0
                      : static_cast<double>(violations) / static_cast<double>(agree + violations);
  }
};

/// Compares two groups: each point is projected into the views of the other group.
///
/// A point agrees within `gate_mm` of a surface that faces the same way. A point farther in front
/// of a measured surface violates free space: that view looked through the place where it lies.
[[nodiscard]] GroupFit compare_groups(const ViewGroup& to,
                                      const ViewGroup& from,
                                      const Eigen::Isometry3d& to_from,
                                      const GroupViews& views,
                                      double gate_mm);

/// The first and the smallest gate of a robust fit.
struct GateRange {
  double widest_mm = 0.0;  ///< gate of the first iteration
  double least_mm = 0.0;   ///< the gate never closes further
};

/// The pose near `to_from` in which the groups fit best, by `minimize_robustly` with a gate that
/// closes from `widest_mm` to no less than `least_mm`.
[[nodiscard]] Eigen::Isometry3d refine_fit(const ViewGroup& to,
                                           const ViewGroup& from,
                                           Eigen::Isometry3d to_from,
                                           const GroupViews& views,
                                           const GateRange& gate);

}  // namespace frangia
