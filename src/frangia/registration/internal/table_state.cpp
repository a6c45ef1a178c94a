#include "frangia/registration/internal/table_state.h"

namespace frangia {

std::size_t TableState::closing_view() const {
  std::size_t last = 0;
  for (std::size_t view = 0; view < angles_rad.size(); ++view)
    if (setup_of(view) == 0) last = view;
  return last;
}

Eigen::Matrix<double, 3, 2> perpendicular_directions(const Turntable& table) {
  Eigen::Vector3d least = Eigen::Vector3d::Zero();
  Eigen::Index thinnest = 0;
  table.axis.cwiseAbs().minCoeff(&thinnest);
  least[thinnest] = 1.0;
  Eigen::Matrix<double, 3, 2> sides;
  sides.col(0) = table.axis.cross(least).normalized();
  sides.col(1) = table.axis.cross(sides.col(0));
  return sides;
}

Turntable nearest_to(const Turntable& given, Turntable refined) {
  const Eigen::Vector3d away = given.point_mm - refined.point_mm;
  refined.point_mm += refined.axis * refined.axis.dot(away);
  return refined;
}

TableState apply_update(const TableState& state, const Eigen::VectorXd& step) {
  const Eigen::Matrix<double, 3, 2> sides = perpendicular_directions(state.table);
  TableState next = state;
  const Eigen::Vector3d tilt = sides * step.head<2>();
  if (tilt.norm() > 0.0) {
    next.table.axis = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * state.table.axis;
    next.table.axis.normalize();
  }
  next.table.point_mm += sides * step.segment<2>(2);
  for (std::size_t view = 1; view < state.angles_rad.size(); ++view) {
    next.angles_rad[view] += step[static_cast<Eigen::Index>(view) + 3];
  }
  const Eigen::Vector3d& center = state.table.point_mm;  // as in the Jacobian, not yet shifted
  for (std::size_t setup = 1; setup <= state.part_poses.size(); ++setup) {
    const auto part = step.segment<6>(state.index_of_setup(setup));
    const Eigen::Vector3d turn = part.tail<3>();
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0)
      move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    move.translation() = center + part.head<3>() - move.linear() * center;
    next.part_poses[setup - 1] = move * state.part_poses[setup - 1];
  }
  return next;
}

Eigen::VectorXd deviation(const TableState& state, const TableState& given) {
  const Eigen::Matrix<double, 3, 2> sides = perpendicular_directions(state.table);
  Eigen::VectorXd away = Eigen::VectorXd::Zero(state.unknowns());
  away.head<2>() = sides.transpose() * given.table.axis.cross(state.table.axis);
  away.segment<2>(2) = sides.transpose() * (state.table.point_mm - given.table.point_mm);
  for (std::size_t view = 1; view < state.angles_rad.size(); ++view)
    away[static_cast<Eigen::Index>(view) + 3] = state.angles_rad[view] - given.angles_rad[view];
  return away;
}

}  // namespace frangia
