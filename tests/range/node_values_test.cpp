#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "frangia/range/internal/phase_sample.h"

namespace frangia {
namespace {

TEST(FillMissing, TakesTheNearestKnownNodeOfTheGrid) {
  constexpr std::array<int, 3> kCounts{4, 3, 2};
  const auto node = [&](int x, int y, int z) { return x + kCounts[0] * (y + kCounts[1] * z); };
  Eigen::MatrixXd nodes =
      Eigen::MatrixXd::Constant(2, 24, std::numeric_limits<double>::quiet_NaN());
  nodes.col(node(0, 0, 0)) << 1.0, 10.0;
  nodes.col(node(3, 2, 1)) << 2.0, 20.0;
  nodes(0, node(0, 2, 0)) = 5.0;  // the other row is missing: the node is
  fill_missing(nodes, kCounts);
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) {
        const int to_first = x * x + y * y + z * z;
        const int to_last = (3 - x) * (3 - x) + (2 - y) * (2 - y) + (1 - z) * (1 - z);
        if (to_first == to_last) continue;
        const double wanted = to_first < to_last ? 1.0 : 2.0;
        EXPECT_EQ(nodes(0, node(x, y, z)), wanted) << x << y << z;
        EXPECT_EQ(nodes(1, node(x, y, z)), 10.0 * wanted) << x << y << z;
      }
    }
  }
}

TEST(FillMissing, IsZeroWithoutAKnownNode) {
  Eigen::MatrixXd nodes = Eigen::MatrixXd::Constant(1, 8, std::numeric_limits<double>::quiet_NaN());
  fill_missing(nodes, {2, 2, 2});
  EXPECT_EQ(nodes, Eigen::MatrixXd::Zero(1, 8));
}

TEST(PrincipalComponents, KeepTheSumsOfSquaresWithTheFewestRows) {
  Eigen::MatrixXd shapes(2, 40);
  for (Eigen::Index i = 0; i < 40; ++i)
    shapes.col(i) << std::sin(0.3 * static_cast<double>(i)), std::cos(0.1 * static_cast<double>(i));
  Eigen::MatrixXd mixed(6, 2);
  mixed << 1, 0, 0.5, -1, 2, 1, 0, 3, 0.1, 0.1, -1, 0.7;
  const Eigen::MatrixXd rows = mixed * shapes;
  const Eigen::MatrixXf found = principal_components(rows);
  ASSERT_EQ(found.rows(), 2);
  const Eigen::RowVectorXd wanted = rows.colwise().squaredNorm();
  const Eigen::RowVectorXd squares = found.cast<double>().colwise().squaredNorm();
  EXPECT_LT((squares - wanted).cwiseAbs().maxCoeff(), 1e-4 * wanted.mean());
}

TEST(PrincipalComponents, LeaveOutATenThousandthOfTheSumOfSquares) {
  for (const double small : {0.009, 0.011}) {  // squares of 0.8e-4 and 1.2e-4
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, 10);
    rows.row(0).setConstant(1.0);
    for (Eigen::Index i = 0; i < 10; ++i)
      rows(1, i) = i % 2 == 0 ? small : -small;
    EXPECT_EQ(principal_components(rows).rows(), small < 0.01 ? 1 : 2);
  }
}

}  // namespace
}  // namespace frangia
