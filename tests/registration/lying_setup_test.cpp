// Motions of a part that lies on the table in its second setup.
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/registration/explain/internal/cause_motions.h"

namespace frangia {
namespace {

/// A view of the first setup, and one after the part was laid down.
PoseSetting lying() {
  PoseSetting setting;
  setting.views = 2;
  setting.center_mm = {1.0, 2.0, 30.0};
  setting.radius_mm = 20.0;
  const Eigen::Isometry3d laid(Eigen::Translation3d(0.0, 5.0, 40.0) *
                               Eigen::AngleAxisd(rad_from_deg(90.0), Eigen::Vector3d::UnitX()));
  setting.object_from_table = {Eigen::Isometry3d::Identity(), laid};
  return setting;
}

TEST(LyingSetup, APartSlidesAlongTheTableOnWhichItLies) {
  constexpr double kOff = 0.03;
  const PoseSetting setting = lying();
  const CauseHypothesis slide{PoseCause::PartMoved, {1}, 2.0, 0.0, true};
  const Eigen::MatrixXd motions = motions_of(slide, setting, 12);
  ASSERT_EQ(motions.cols(), 6);
  EXPECT_TRUE(motions.topRows(6).isZero());
  double along_mm = 0.0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::Vector3d turn = motions.block<3, 1>(6, i);
    const Eigen::Vector3d way = motions.block<3, 1>(9, i) + turn.cross(setting.center_mm);
    EXPECT_LE(std::abs(way.y()), kOff * 2.0 + 1e-9) << i;  // y of the part is up
    along_mm = std::max(along_mm, std::abs(way.z()));
  }
  EXPECT_NEAR(along_mm, 2.0, 1e-9);
}

TEST(LyingSetup, TheTableTurnsAboutItsAxisInThePart) {
  const PoseSetting setting = lying();
  const Eigen::MatrixXd turn = motions_of({PoseCause::Turned, {1}, 1.0}, setting, 12);
  ASSERT_EQ(turn.cols(), 1);
  const Eigen::Vector3d axis = turn.block<3, 1>(6, 0) * setting.radius_mm;
  EXPECT_NEAR(std::abs(axis.y()), 1.0, 1e-9);
  // A point of the axis stays.
  const Eigen::Vector3d on_axis = setting.object_from_table[1] * Eigen::Vector3d(0.0, 0.0, 7.0);
  const Eigen::Vector3d way = axis.cross(on_axis) + turn.block<3, 1>(9, 0) * setting.radius_mm;
  EXPECT_LT(way.norm(), 1e-9);
}

}  // namespace
}  // namespace frangia
