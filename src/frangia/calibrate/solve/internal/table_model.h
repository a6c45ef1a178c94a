#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace frangia {

constexpr Eigen::Index kAxisParameters = 4;                     // two turns, two shifts
constexpr Eigen::Index kTableParameters = kAxisParameters + 6;  // and the pose of the board
using TableStep = Eigen::Matrix<double, kTableParameters, 1>;

/// The turning board.
struct TableModel {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d axis;
  Eigen::Isometry3d rig_from_board;  ///< at angle 0

  [[nodiscard]] Eigen::Isometry3d at(double angle_rad) const {
    return Eigen::Translation3d(point_mm) * Eigen::AngleAxisd(angle_rad, axis) *
           Eigen::Translation3d(-point_mm) * rig_from_board;
  }

  /// Two directions across the axis.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> across() const {
    Eigen::Matrix<double, 3, 2> directions;
    directions.col(0) = axis.unitOrthogonal();
    directions.col(1) = axis.cross(directions.col(0));
    return directions;
  }

  [[nodiscard]] TableModel moved(const TableStep& step) const {
    TableModel out = *this;
    const Eigen::Matrix<double, 3, 2> sides = across();
    out.axis = (axis + sides * step.head<2>()).normalized();
    out.point_mm += sides * step.segment<2>(2);
    const Eigen::Vector3d turn = step.segment<3>(4);
    const double angle = turn.norm();
    if (angle > 0.0) {
      out.rig_from_board.linear() =
          Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * rig_from_board.linear();
    }
    out.rig_from_board.translation() += step.tail<3>();
    return out;
  }
};

}  // namespace frangia
