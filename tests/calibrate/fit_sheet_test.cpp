#include "frangia/calibrate/internal/fit_sheet.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/calibrate/internal/assess_solution.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

const LaserSheet kSheet{Eigen::Vector3d(0.9, 0.1, -0.3).normalized(), -120.0};

/// Points on the sheet with noise along its normal; a share of them is anywhere.
std::vector<Eigen::Vector3d> sheet_points(std::uint64_t count, double noise_mm, double wrong) {
  const Eigen::Vector3d u = kSheet.normal.unitOrthogonal();
  const Eigen::Vector3d v = kSheet.normal.cross(u);
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto draw = [&](std::uint64_t k) {
      return 100.0 * uniform_from(hash(hash(9, i), k)) - 50.0;
    };
    double off = noise_mm * normal_from(hash(hash(8, i), 1));
    if (uniform_from(hash(hash(7, i), 2)) < wrong) off = 5.0 + std::abs(draw(3));
    points.emplace_back((kSheet.offset_mm + off) * kSheet.normal + draw(1) * u + draw(2) * v);
  }
  return points;
}

TEST(FitSheet, FindsThePlaneDespiteFortyPercentOfOtherPoints) {
  for (const double sign : {1.0, -1.0}) {
    const LaserSheet start{sign * kSheet.normal, 0.0};
    const SheetFit found = fit_sheet(sheet_points(400, 0.05, 0.4), start);
    EXPECT_NEAR(found.sheet.normal.dot(kSheet.normal), sign, 1e-5);
    EXPECT_NEAR(found.sheet.offset_mm, sign * kSheet.offset_mm, 0.02);
    EXPECT_NEAR(found.rms_mm, 0.05, 0.008);
    EXPECT_GT(found.points, 220U);
    EXPECT_LE(found.points, 260U);
  }
}

TEST(FitSheet, NeedsTenPointsThatAgree) {
  const LaserSheet start{Eigen::Vector3d::UnitX(), 3.0};
  EXPECT_EQ(fit_sheet(sheet_points(9, 0.0, 0.0), start).points, 0U);
  EXPECT_EQ(fit_sheet(sheet_points(9, 0.0, 0.0), start).sheet.offset_mm, 3.0);
  EXPECT_EQ(fit_sheet(sheet_points(10, 0.0, 0.0), start).points, 10U);
}

TEST(InvertNormal, LeavesOutDirectionsThatTheDataDoNotDetermine) {
  // Of two parameters only the sum is measured, of a third all; scales differ.
  Eigen::MatrixXd jacobian(3, 3);
  jacobian << 2.0, 2e3, 0.0, 1.0, 1e3, 0.0, 0.0, 0.0, 5.0;
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const NormalInverse found = invert_normal(normal, 1e-9);
  EXPECT_NEAR(found.open[0], 0.5, 1e-6);
  EXPECT_NEAR(found.open[1], 0.5, 1e-6);
  EXPECT_NEAR(found.open[2], 0.0, 1e-6);
  EXPECT_NEAR(found.covariance(2, 2), 1.0 / 25.0, 1e-9);
  // What is determined, the sum, has its variance: a + 1000 b with 1 / (4 + 1).
  const Eigen::Vector3d sum(1.0, 1e3, 0.0);
  EXPECT_NEAR(sum.dot(found.covariance * sum), 1.0 / 5.0, 1e-6);
}

TEST(InvertNormal, IsTheInverseWhereAllIsDetermined) {
  Eigen::Matrix3d root;
  root << 3.0, 0.2, 0.1, 0.0, 40.0, 1.0, 0.0, 0.0, 0.02;
  const Eigen::MatrixXd normal = root.transpose() * root;
  const NormalInverse found = invert_normal(normal, 1e-12);
  const Eigen::MatrixXd identity = found.covariance * normal;
  EXPECT_LT((identity - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(found.open.sum(), 0.0);
  const NormalInverse unknown = invert_normal(Eigen::Matrix2d{{4.0, 0.0}, {0.0, 0.0}}, 1e-12);
  EXPECT_NEAR(unknown.covariance(0, 0), 0.25, 1e-12);
  EXPECT_EQ(unknown.open[1], 1.0);
}

}  // namespace
}  // namespace frangia
