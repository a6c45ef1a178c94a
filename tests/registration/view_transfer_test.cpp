#include "frangia/registration/internal/view_transfer.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

/// Four views in two setups, nothing parallel to a coordinate axis.
TableState tilted_state() {
  TableState state{{{2.0, 48.0, 516.0}, Eigen::Vector3d(0.03, -0.9, -0.42).normalized()},
                   {0.1, 1.3, 2.9, 4.4},
                   {0, 0, 1, 1},
                   {}};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(30.0, -12.0, 25.0);
  state.part_poses = {pose};
  return state;
}

/// Places `jacobian` in a row of all unknowns, as TableState orders them.
Eigen::VectorXd row_of(const TableState& state,
                       const PairJacobian& jacobian,
                       std::size_t from,
                       std::size_t to) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(state.unknowns());
  row.head<2>() = jacobian.tilt;
  row.segment<2>(2) = jacobian.shift;
  if (to != 0) row[static_cast<Eigen::Index>(to) + 3] += jacobian.angle_to;
  if (from != 0) row[static_cast<Eigen::Index>(from) + 3] += jacobian.angle_from;
  if (state.setup_of(to) == state.setup_of(from)) return row;
  if (state.setup_of(to) != 0) row.segment<6>(state.index_of_setup(1)) += jacobian.setup_to;
  if (state.setup_of(from) != 0) row.segment<6>(state.index_of_setup(1)) += jacobian.setup_from;
  return row;
}

TEST(ViewTransfer, HasTheDerivativesOfCentralDifferences) {
  const TableState state = tilted_state();
  const Eigen::Vector3d point(12.0, 30.0, 490.0);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.5, -0.8).normalized();
  for (const auto& [from, to] : std::vector<std::pair<std::size_t, std::size_t>>{
           {0, 1}, {1, 0}, {1, 3}, {3, 1}, {2, 3}, {0, 2}}) {
    const Eigen::VectorXd row =
        row_of(state, ViewTransfer(state, from, to).jacobian(normal, point), from, to);
    for (Eigen::Index i = 0; i < state.unknowns(); ++i) {
      constexpr double kStep = 1e-5;  // rad or mm
      const auto residual = [&](double step) {
        const Eigen::VectorXd moved = step * Eigen::VectorXd::Unit(state.unknowns(), i);
        return normal.dot(ViewTransfer(apply_update(state, moved), from, to).apply(point));
      };
      const double difference = (residual(kStep) - residual(-kStep)) / (2.0 * kStep);
      EXPECT_NEAR(row[i], difference, 1e-5 * std::max(1.0, std::abs(difference)))
          << "unknown " << i << ", views " << from << " and " << to;
    }
  }
}

TEST(ViewTransfer, MovesAPointAsThePosesOfBothViewsDo) {
  const TableState state = tilted_state();
  const Eigen::Isometry3d turn_0 =
      state.table.rig_from_object(state.angles_rad[1]) * state.table.rig_from_object(0.0).inverse();
  const Eigen::Isometry3d turn_1 =
      state.table.rig_from_object(state.angles_rad[2]) * state.table.rig_from_object(0.0).inverse();
  const Eigen::Vector3d point(12.0, 30.0, 490.0);
  const Eigen::Vector3d wanted = turn_1 * (state.part_poses[0] * (turn_0.inverse() * point));
  EXPECT_TRUE(ViewTransfer(state, 1, 2).apply(point).isApprox(wanted, 1e-12));
}

TEST(ApplyUpdate, KeepsTheAxisAUnitVectorAndTheFirstAngle) {
  const TableState state = tilted_state();
  const TableState next = apply_update(state, Eigen::VectorXd::Constant(state.unknowns(), 0.3));
  EXPECT_NEAR(next.table.axis.norm(), 1.0, 1e-12);
  EXPECT_EQ(next.angles_rad[0], state.angles_rad[0]);
  EXPECT_NEAR(next.angles_rad[2], state.angles_rad[2] + 0.3, 1e-12);
  EXPECT_NEAR((next.table.point_mm - state.table.point_mm).norm(), 0.3 * std::sqrt(2.0), 1e-12);
}

TEST(TableState, ClosesTheTurnWithTheLastViewOfTheFirstSetup) {
  EXPECT_EQ(tilted_state().closing_view(), 1U);
}

}  // namespace
}  // namespace frangia
