#include "frangia/core/least_squares.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(LeastSquares, LeavesAResidualThatIsNormalToEveryColumn) {
  Eigen::MatrixXd matrix(4, 2);
  matrix << 1, 0, 1, 1, 1, 2, 1, 3;
  Eigen::MatrixXd right(4, 2);
  right << 1, 5, 3, 5, 2, 5, 6, 5;
  const Eigen::MatrixXd found = least_squares(matrix, right);
  // The line through (0, 1), (1, 3), (2, 2), (3, 6) by the formulas of linear regression.
  EXPECT_NEAR(found(0, 0), 0.9, 1e-12);
  EXPECT_NEAR(found(1, 0), 1.4, 1e-12);
  EXPECT_NEAR(found(0, 1), 5.0, 1e-12);
  EXPECT_NEAR(found(1, 1), 0.0, 1e-12);
  EXPECT_LT((matrix.transpose() * (matrix * found - right)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LeastSquares, SetsWhatIsNotDeterminedToZero) {
  const Eigen::MatrixXd matrix = Eigen::Vector3d(1, 1, 1) * Eigen::RowVector2d(2, 1);
  const Eigen::MatrixXd found = least_squares(matrix, Eigen::Vector3d(4, 4, 4));
  EXPECT_NEAR(found(0), 2.0, 1e-12);
  EXPECT_EQ(found(1), 0.0);
}

}  // namespace
}  // namespace frangia
