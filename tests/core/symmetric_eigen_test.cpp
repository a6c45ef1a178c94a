#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

TEST(SymmetricEigen, EigenvaluesOfA3x3MatrixAscendAndMatchTheirVectors) {
  // Eigenvalues 2 - sqrt 2, 2 and 2 + sqrt 2.
  const Eigen::Matrix3d matrix{{2.0, -1.0, 0.0}, {-1.0, 2.0, -1.0}, {0.0, -1.0, 2.0}};
  const SymmetricEigen<3> eigen = symmetric_eigen(matrix);
  EXPECT_NEAR(eigen.values[0], 2.0 - std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(eigen.values[1], 2.0, 1e-12);
  EXPECT_NEAR(eigen.values[2], 2.0 + std::sqrt(2.0), 1e-12);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d vector = eigen.vectors.col(i);
    EXPECT_NEAR(vector.norm(), 1.0, 1e-12);
    EXPECT_LT((matrix * vector - eigen.values[i] * vector).norm(), 1e-12);
  }
}

TEST(SymmetricEigen, ReadsTheLowerTriangleOnlyForAnySize) {
  const Eigen::MatrixXd lower{{1.0, 99.0}, {2.0, 1.0}};
  const auto eigen = symmetric_eigen(lower);
  ASSERT_EQ(eigen.values.size(), 2);
  EXPECT_NEAR(eigen.values[0], -1.0, 1e-12);
  EXPECT_NEAR(eigen.values[1], 3.0, 1e-12);
}

}  // namespace
}  // namespace frangia
