#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

const Eigen::MatrixXd kWide{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
const Eigen::MatrixXd kSquare{{2.0, -1.0}, {-1.0, 3.0}};

TEST(MatrixProducts, AreThoseByHand) {
  const Eigen::MatrixXd by_hand{{-2.0, -1.0, 0.0}, {11.0, 13.0, 15.0}};
  EXPECT_EQ(product(kSquare, kWide), by_hand);
  EXPECT_EQ(transposed_product(kSquare, kWide), by_hand);  // it is symmetric
  EXPECT_EQ(transposed_product(kWide, kSquare), by_hand.transpose());
  const Eigen::MatrixXd of_rows{{14.0, 32.0}, {32.0, 77.0}};
  EXPECT_EQ(product_transposed(kWide, kWide), of_rows);
}

TEST(MatrixProducts, OfAVectorAreVectors) {
  const Eigen::VectorXd x{{1.0, 0.0, -1.0}};
  static_assert(std::is_same_v<decltype(product(kWide, x)), Eigen::VectorXd>);
  EXPECT_EQ(product(kWide, x), Eigen::VectorXd({{-2.0, -2.0}}));
  EXPECT_EQ(transposed_product(kWide, x.head(2)), Eigen::VectorXd({{1.0, 2.0, 3.0}}));
}

TEST(MatrixProducts, ExpressAFormInOtherUnknowns) {
  // x = A y with y = (1, 2, 3): x^T B x by hand.
  const Eigen::VectorXd y{{1.0, 2.0, 3.0}};
  const Eigen::VectorXd x{{14.0, 32.0}};
  const double by_hand = 2.0 * 14.0 * 14.0 - 2.0 * 14.0 * 32.0 + 3.0 * 32.0 * 32.0;
  EXPECT_EQ(y.dot(congruence(kWide, kSquare) * y), by_hand);
  EXPECT_EQ(scaled(kSquare, Eigen::VectorXd{{2.0, 3.0}}),
            (Eigen::MatrixXd{{8.0, -6.0}, {-6.0, 27.0}}));
}

TEST(Cholesky, SolvesAndKnowsItsDeterminant) {
  const Cholesky factors(kSquare);
  EXPECT_TRUE(factors.is_positive());
  EXPECT_LT((factors.solve(Eigen::VectorXd{{1.0, 2.0}}) - Eigen::VectorXd{{1.0, 1.0}}).norm(),
            1e-15);
  EXPECT_LT((factors.solve_columns(kSquare) - Eigen::MatrixXd::Identity(2, 2)).norm(), 1e-15);
  EXPECT_NEAR(factors.log_determinant(), std::log(5.0), 1e-15);
  EXPECT_LT((factors.inverse_lower() * factors.lower() - Eigen::MatrixXd::Identity(2, 2)).norm(),
            1e-15);
}

TEST(Cholesky, NamesWhatIsNotPositive) {
  EXPECT_FALSE(Cholesky(Eigen::MatrixXd{{1.0, 2.0}, {2.0, 1.0}}).is_positive());
}

}  // namespace
}  // namespace frangia
