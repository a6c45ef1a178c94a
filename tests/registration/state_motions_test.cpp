#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/register_views.h"

namespace frangia {
namespace {

using Motion = Eigen::Matrix<double, 6, 1>;

TableState two_setups() {
  TableState state;
  state.table.point_mm = {12.0, 40.0, 520.0};
  state.table.axis = Eigen::Vector3d(0.1, -0.9, -0.3).normalized();
  state.angles_rad = {0.3, 1.4, 2.9, 0.2};
  state.setups = {0, 0, 0, 1};
  Eigen::Isometry3d part = Eigen::Isometry3d::Identity();
  part.linear() =
      Eigen::AngleAxisd(1.2, Eigen::Vector3d(0.4, 0.8, -0.2).normalized()).toRotationMatrix();
  part.translation() = Eigen::Vector3d(30.0, -10.0, 25.0);
  state.part_poses = {part};
  return state;
}

/// Where a point that was measured with the poses `before` lies if those `after` are right.
Eigen::Vector3d moved_to(const Eigen::Isometry3d& before,
                         const Eigen::Isometry3d& after,
                         const Eigen::Vector3d& point) {
  return after.inverse() * (before * point);
}

TEST(ObjectPoses, PlaceTheObjectOfASecondSetupByItsPartPose) {
  const TableState state = two_setups();
  const std::vector<Eigen::Isometry3d> poses = object_poses(state);
  ASSERT_EQ(poses.size(), 4U);
  for (std::size_t view = 0; view < 3; ++view)
    EXPECT_TRUE(poses[view].isApprox(state.table.rig_from_object(state.angles_rad[view])));
  // The part pose moves the part at angle 0, in the rig frame; the table then turns it.
  const Eigen::Vector3d in_object(3.0, -5.0, 8.0);
  const Eigen::Vector3d at_zero =
      state.part_poses[0] * (state.table.rig_from_object(0.0) * in_object);
  const Eigen::Vector3d turned =
      state.table.point_mm +
      Eigen::AngleAxisd(state.angles_rad[3], state.table.axis) * (at_zero - state.table.point_mm);
  EXPECT_LT((poses[3] * in_object - turned).norm(), 1e-9);
}

TEST(StateMotions, AreTheMotionsByEachUnknown) {
  const TableState state = two_setups();
  const Eigen::Index unknowns = state.unknowns();
  ASSERT_EQ(unknowns, 4 + 3 + 6);
  const Eigen::VectorXd sigma = Eigen::VectorXd::LinSpaced(unknowns, 1e-5, 3e-5);
  const ViewMotions motions = state_motions(state, sigma, {}, Eigen::VectorXd::Zero(unknowns));
  const std::vector<Eigen::Isometry3d> poses = object_poses(state);
  ASSERT_EQ(motions.size(), poses.size());
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const Eigen::VectorXd step = sigma[i] * Eigen::VectorXd::Unit(unknowns, i);
    const std::vector<Eigen::Isometry3d> after = object_poses(apply_update(state, step));
    for (std::size_t view = 0; view < poses.size(); ++view) {
      ASSERT_EQ(motions[view].cols(), unknowns);
      const Motion motion = motions[view].col(i);
      for (const Eigen::Vector3d& point :
           {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(50, -20, 30), Eigen::Vector3d(-10, 60, 5)}) {
        const Eigen::Vector3d wanted = moved_to(poses[view], after[view], point) - point;
        const Eigen::Vector3d found = motion.head<3>().cross(point) + motion.tail<3>();
        EXPECT_LT((found - wanted).norm(), 2e-3 * wanted.norm() + 1e-8) << i << " " << view;
      }
    }
  }
}

TEST(StateMotions, OfAnAngleTurnTheObjectBack) {
  const TableState state = two_setups();
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(state.unknowns());
  sigma[5] = 2e-3;  // of view 2
  const ViewMotions motions = state_motions(state, sigma, {}, sigma);
  for (std::size_t view = 0; view < 4; ++view) {
    Motion wanted = Motion::Zero();
    if (view == 2) wanted[2] = -2e-3;
    EXPECT_LT((motions[view].col(5) - wanted).norm(), 1e-7) << view;
  }
}

TEST(StateMotions, ShrinkByWhatThePairsAdd) {
  const TableState state = two_setups();
  const Eigen::Index unknowns = state.unknowns();
  const Eigen::VectorXd sigma = Eigen::VectorXd::LinSpaced(unknowns, 1e-3, 3e-3);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(unknowns);
  const Eigen::VectorXd offset = Eigen::VectorXd::LinSpaced(unknowns, -2e-3, 1e-3);
  const ViewMotions prior = state_motions(state, sigma, {}, none);
  for (const double gain : {0.0, 3.0, 399.0, 401.0}) {
    const Eigen::MatrixXd information = (gain * sigma.cwiseAbs2().cwiseInverse()).asDiagonal();
    const ViewMotions left = state_motions(state, sigma, information, offset);
    for (std::size_t view = 0; view < 4; ++view) {
      ASSERT_EQ(left[view].cols(), unknowns + 1);
      const Eigen::MatrixXd scatter =
          left[view].leftCols(unknowns) * left[view].leftCols(unknowns).transpose();
      const Eigen::MatrixXd wanted = prior[view] * prior[view].transpose() / (1.0 + gain);
      EXPECT_LT((scatter - wanted).norm(), 1e-9 * wanted.norm());
      // The offset counts by the weight of the pairs, unless they determine the direction well.
      const Eigen::VectorXd agreed =
          gain < 400.0 ? Eigen::VectorXd(gain / (1.0 + gain) * offset) : none;
      const Motion towards = prior[view] * agreed.cwiseQuotient(sigma);
      EXPECT_LT((left[view].col(unknowns) - towards).norm(), 1e-9 + 1e-9 * towards.norm()) << gain;
    }
  }
}

TEST(SigmasOf, SetsTheTableAndKeepsThePrior) {
  const TableState state = two_setups();
  const TurntableSigma sigma{.point_mm = 0.3, .axis_rad = 2e-3, .angle_rad = 5e-4};
  const Eigen::VectorXd found = sigmas_of(state, sigma, Eigen::VectorXd::Constant(13, 7.0));
  Eigen::VectorXd wanted(13);
  wanted << 2e-3, 2e-3, 0.3, 0.3, 5e-4, 5e-4, 5e-4, 7, 7, 7, 7, 7, 7;
  EXPECT_EQ(found, wanted);
}

TEST(SigmaOfTurntable, IsWhatTheRigStatesOrAQuarterOfThePriors) {
  Turntable table;
  const RegisterOptions options;
  const TurntableSigma unknown = sigma_of(table, options, 500.0);
  EXPECT_NEAR(unknown.point_mm, 0.25 * 0.004 * 500.0, 1e-12);
  EXPECT_NEAR(unknown.axis_rad, 0.25 * options.tilt_sigma_rad, 1e-12);
  EXPECT_NEAR(unknown.angle_rad, 0.25 * options.angle_sigma_rad, 1e-12);
  EXPECT_FALSE(unknown.stated);
  table.point_sigma_mm = 0.02;
  table.axis_sigma_rad = 1e-4;
  EXPECT_FALSE(sigma_of(table, options, 500.0).stated);
  table.angle_sigma_rad = 2e-5;
  const TurntableSigma known = sigma_of(table, options, 500.0);
  EXPECT_EQ(known.point_mm, 0.02);
  EXPECT_EQ(known.axis_rad, 1e-4);
  EXPECT_EQ(known.angle_rad, 2e-5);
  EXPECT_TRUE(known.stated);
}

TEST(MotionsOfRig, HaveAColumnForTheAxisAndEachAngleButTheFirst) {
  const TableState state = two_setups();
  std::vector<Station> stations;
  for (const double angle : {0.3, 1.4, 2.9})
    stations.push_back({.angle_rad = angle, .name = {}});
  const ViewMotions motions = motions_of_rig({state.table, stations}, {0.2, 1e-3, 4e-4});
  ASSERT_EQ(motions.size(), 3U);
  for (const auto& motion : motions) {
    ASSERT_EQ(motion.cols(), 6);
    for (const Eigen::Index shift : {2, 3}) {  // across the axis, by a sigma
      EXPECT_NEAR(motion.col(shift).tail<3>().norm(), 0.2, 1e-5);
      EXPECT_NEAR(motion(5, shift), 0.0, 1e-6);
    }
  }
  EXPECT_NEAR(motions[1](2, 4), -4e-4, 1e-8);
  EXPECT_NEAR(motions[2](2, 5), -4e-4, 1e-8);
  EXPECT_NEAR(motions[0](2, 5), 0.0, 1e-8);
  EXPECT_TRUE(motions_of_rig({state.table, {}}, {}).empty());
}

}  // namespace
}  // namespace frangia
