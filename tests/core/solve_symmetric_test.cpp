#include <gtest/gtest.h>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

TEST(SolveSymmetric, RecoversAKnownSolution) {
  const Eigen::MatrixXd matrix{{4.0, 1.0, -2.0}, {1.0, 3.0, 0.5}, {-2.0, 0.5, 6.0}};
  const Eigen::VectorXd x{{1.0, -2.0, 0.25}};
  const Eigen::VectorXd right{{1.5, -4.875, -1.5}};
  EXPECT_LT((solve_symmetric(matrix, right) - x).norm(), 1e-12);
}

TEST(SolveSymmetric, SolvesEachColumn) {
  const Eigen::MatrixXd matrix{{2.0, 1.0}, {1.0, 2.0}};
  const Eigen::MatrixXd x = solve_symmetric_columns(matrix, Eigen::MatrixXd::Identity(2, 2));
  EXPECT_LT((x - Eigen::MatrixXd{{2.0 / 3.0, -1.0 / 3.0}, {-1.0 / 3.0, 2.0 / 3.0}}).norm(), 1e-12);
}

TEST(SolveSymmetric, ReadsTheLowerTriangleOnly) {
  const Eigen::MatrixXd lower{{2.0, 99.0}, {1.0, 2.0}};
  const Eigen::VectorXd x = solve_symmetric(lower, Eigen::VectorXd{{3.0, 3.0}});
  EXPECT_NEAR(x[0], 1.0, 1e-12);
  EXPECT_NEAR(x[1], 1.0, 1e-12);
}

}  // namespace
}  // namespace frangia
