#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/registration/view_motions.h"

namespace frangia {
namespace {

using MotionOfView = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Three views of which the later two shift by 3 mm along x and along y, each by itself.
ViewMotions shifted_views() {
  ViewMotions motions(3, MotionOfView::Zero(6, 4));
  motions[1](3, 0) = motions[1](4, 1) = 3.0;
  motions[2](3, 2) = motions[2](4, 3) = 3.0;
  return motions;
}

/// Standard deviation of a coordinate of the translation of one view less the mean of two others.
double apart_mm(const ViewMotions& motions, Eigen::Index row) {
  return (motions[1].row(row) - 0.5 * (motions[0].row(row) + motions[2].row(row))).norm();
}

TEST(NarrowMotions, LeaveAViewNoMoreThanIsKnownOfIt) {
  const std::vector<Eigen::Vector3f> points_mm{{10, 0, 0}, {-10, 0, 5}, {0, 10, -5}, {0, -10, 0}};
  ViewMotions motions = shifted_views();
  const double before_mm = apart_mm(motions, 3);
  EXPECT_NEAR(before_mm, std::sqrt(9.0 + 9.0 / 4.0), 1e-9);
  Eigen::Matrix<double, 6, 1> known = Eigen::Matrix<double, 6, 1>::Zero();
  known[3] = 0.1;
  narrow_motions(motions, 1, known, points_mm);
  // The variances of two independent statements combine as their inverses.
  EXPECT_NEAR(apart_mm(motions, 3),
              1.0 / std::sqrt(1.0 / (0.1 * 0.1) + 1.0 / (before_mm * before_mm)),
              1e-9);
  EXPECT_NEAR(apart_mm(motions, 4), before_mm, 1e-9) << "across it nothing is known";
  EXPECT_NEAR(motions[2].row(3).norm(), 3.0, 0.4) << "both together may be anywhere";
}

TEST(NarrowMotions, LeaveViewsWhoseMotionIsNoneAsTheyAre) {
  ViewMotions motions(2, MotionOfView::Zero(6, 1));
  narrow_motions(
      motions, 1, Eigen::Matrix<double, 6, 1>::Unit(3), std::vector{Eigen::Vector3f(1, 2, 3)});
  EXPECT_TRUE(motions[1].isZero());
}

}  // namespace
}  // namespace frangia
