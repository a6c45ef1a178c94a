#include "frangia/registration/internal/table_state.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/core/linear_algebra.h"
#include "frangia/registration/register_views.h"

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

namespace {

/// The small motion that takes points as `one` places them to where `other` does.
Eigen::Matrix<double, 6, 1> motion_between(const Eigen::Isometry3d& one,
                                           const Eigen::Isometry3d& other) {
  const Eigen::Matrix4d change = other.matrix() - one.matrix();
  Eigen::Matrix<double, 6, 1> motion;
  motion << 0.5 * (change(2, 1) - change(1, 2)), 0.5 * (change(0, 2) - change(2, 0)),
      0.5 * (change(1, 0) - change(0, 1)), change.topRightCorner<3, 1>();
  return motion;
}

}  // namespace

ViewMotions motions_by_unknown(const TableState& state) {
  constexpr double kStep = 1e-6;  // rad, and of the distance
  const std::vector<Eigen::Isometry3d> poses = object_poses(state);
  const double step_mm = kStep * std::max(1.0, state.table.point_mm.norm());
  ViewMotions motions(poses.size(), Eigen::Matrix<double, 6, Eigen::Dynamic>(6, state.unknowns()));
  const Eigen::Index further = static_cast<Eigen::Index>(state.angles_rad.size()) + 3;
  for (Eigen::Index i = 0; i < state.unknowns(); ++i) {
    const bool length = (i == 2 || i == 3) || (i >= further && (i - further) % 6 < 3);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(state.unknowns());
    step[i] = length ? step_mm : kStep;
    const std::vector<Eigen::Isometry3d> after = object_poses(apply_update(state, step));
    const std::vector<Eigen::Isometry3d> before = object_poses(apply_update(state, -step));
    for (std::size_t view = 0; view < poses.size(); ++view) {
      motions[view].col(i) = motion_between(before[view].inverse() * poses[view],
                                            after[view].inverse() * poses[view]) /
                             (2.0 * step[i]);
    }
  }
  return motions;
}

std::vector<Eigen::Isometry3d> object_poses(const TableState& state) {
  std::vector<Eigen::Isometry3d> poses;
  const Eigen::Isometry3d rig_from_table = state.table.rig_from_object(0.0);
  for (std::size_t view = 0; view < state.angles_rad.size(); ++view) {
    poses.push_back(
        state.table.rig_from_object(state.angles_rad[view]) *
        (rig_from_table.inverse() * state.part_pose(state.setup_of(view)) * rig_from_table));
  }
  return poses;
}

Eigen::VectorXd sigmas_of(const TableState& state,
                          const TurntableSigma& sigma,
                          const Eigen::VectorXd& prior_sigma) {
  Eigen::VectorXd all = prior_sigma;
  all.head<2>().setConstant(sigma.axis_rad);
  all.segment<2>(2).setConstant(sigma.point_mm);
  all.segment(4, static_cast<Eigen::Index>(state.angles_rad.size()) - 1)
      .setConstant(sigma.angle_rad);
  return all;
}

ViewMotions state_motions(const TableState& state,
                          const Eigen::VectorXd& prior_sigma,
                          const Eigen::MatrixXd& information,
                          const Eigen::VectorXd& offset) {
  Eigen::MatrixXd factor = prior_sigma.asDiagonal();
  if (information.size() > 0) {
    const auto eigen = symmetric_eigen(scaled(information, prior_sigma));
    const Eigen::VectorXd left = (1.0 + eigen.values.array().max(0.0)).rsqrt();
    factor = product(factor, eigen.vectors) * left.asDiagonal();
    // Where views overlap well, the offset is the error of the state that they fit best, and below
    // what they distinguish.
    constexpr double kWell = 400.0;  // information over that of the prior: 20 times less sigma
    const Eigen::VectorXd weak = (eigen.values.array() < kWell).cast<double>();
    const Eigen::VectorXd towards = product(
        factor, weak.cwiseProduct(transposed_product(factor, product(information, offset))));
    factor.conservativeResize(Eigen::NoChange, factor.cols() + 1);
    factor.rightCols<1>() = towards;
  }
  ViewMotions motions = motions_by_unknown(state);
  for (auto& motion : motions)
    motion = product(motion, factor);
  return motions;
}

TurntableSigma sigma_of(const Turntable& table,
                        const RegisterOptions& options,
                        double distance_mm) {
  const double share = options.unverified_share;
  const auto known = [](double stated, double otherwise) {
    return std::isnan(stated) ? otherwise : stated;
  };
  return {known(table.point_sigma_mm, share * options.relative_shift_sigma * distance_mm),
          known(table.axis_sigma_rad, share * options.tilt_sigma_rad),
          known(table.angle_sigma_rad, share * options.angle_sigma_rad),
          !std::isnan(table.point_sigma_mm + table.axis_sigma_rad + table.angle_sigma_rad)};
}

ViewMotions motions_of_rig(const TurntableStations& given, const TurntableSigma& sigma) {
  TableState state{given.table, {}, {}};
  for (const Station& station : given.stations)
    state.angles_rad.push_back(station.angle_rad);
  if (state.angles_rad.empty()) return {};
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(state.unknowns());
  return state_motions(state, sigmas_of(state, sigma, none), {}, none);
}

}  // namespace frangia
