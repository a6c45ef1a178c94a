#include <gtest/gtest.h>

#include "frangia/core/linear_algebra.h"

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

TEST(LeastSquares, SplitsASpaceByTheRankOfTheColumns) {
  // The third column is the sum of the others.
  const Eigen::MatrixXd matrix{{1.0, 0.0, 1.0}, {1.0, 1.0, 2.0}, {0.0, 2.0, 2.0}, {0.0, 0.0, 0.0}};
  const ColumnSpace space = column_space(matrix, 1e-6);
  ASSERT_EQ(space.span.cols(), 2);
  ASSERT_EQ(space.rest.cols(), 2);
  Eigen::MatrixXd all(4, 4);
  all << space.span, space.rest;
  EXPECT_LT((all.transpose() * all - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-12);
  EXPECT_LT((space.rest.transpose() * matrix).norm(), 1e-12);
}

TEST(LeastSquares, SpansTheColumnsByOrthonormalOnes) {
  const Eigen::MatrixXd matrix{{1.0, 0.0}, {1.0, 1.0}, {0.0, 2.0}};
  const Eigen::MatrixXd basis = orthonormal_basis(matrix);
  EXPECT_LT((basis.transpose() * basis - Eigen::MatrixXd::Identity(2, 2)).norm(), 1e-12);
  EXPECT_LT((basis * (basis.transpose() * matrix) - matrix).norm(), 1e-12);
}

}  // namespace
}  // namespace frangia
