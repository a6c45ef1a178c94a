#include "frangia/geometry/robust_gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// Points of y = exp(a x) + b.
struct Curve {
  std::vector<double> x, y;
  Eigen::Vector2d state{0.0, 0.0};
  double unit = 1.0;  ///< of the second unknown

  RobustProblem problem() {
    return {[this](double gate) {
              Linearization at{Eigen::MatrixXd::Zero(2, 2), Eigen::VectorXd::Zero(2)};
              std::vector<double> residuals;
              for (std::size_t i = 0; i < x.size(); ++i) {
                const double residual = std::exp(state[0] * x[i]) + unit * state[1] - y[i];
                if (!(std::abs(residual) < gate)) continue;
                const Eigen::Vector2d row(x[i] * std::exp(state[0] * x[i]), unit);
                const double weight = tukey_weight(residual, gate);
                at.hessian += weight * row * row.transpose();
                at.gradient += weight * residual * row;
                residuals.push_back(std::abs(residual));
              }
              at.median_residual = median(residuals);
              at.unit_weight_sigma = 1.4826 * at.median_residual;
              at.solvable = residuals.size() > 5;
              return at;
            },
            [this](const Eigen::VectorXd& step) { state += step; }};
  }
};

/// a = 0.7, b = -2, noise of 0.01, and every fourth point far off on one side.
Curve curve_with_outliers() {
  Curve curve;
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (int i = 0; i < 400; ++i) {
    curve.x.push_back(0.005 * i);
    const double off = i % 4 == 0 ? 1.5 : 0.0;
    curve.y.push_back(std::exp(0.7 * curve.x.back()) - 2.0 + noise(generator) + off);
  }
  return curve;
}

TEST(TukeyWeight, FallsFromOneToZeroAtTheGate) {
  EXPECT_EQ(tukey_weight(0.0, 2.0), 1.0);
  EXPECT_EQ(tukey_weight(2.0, 2.0), 0.0);
  EXPECT_EQ(tukey_weight(-3.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(tukey_weight(1.0, 2.0), 0.5625);  // (1 - 1/4)^2
}

TEST(MinimizeRobustly, FindsACurveAmongOutliers) {
  Curve curve = curve_with_outliers();
  const auto result = minimize_robustly(curve.problem(), {.gate = 20.0, .max_iterations = 60});
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(curve.state[0], 0.7, 0.003);  // standard errors of 0.0008 and 0.0015
  EXPECT_NEAR(curve.state[1], -2.0, 0.006);
  EXPECT_LT(result.gate, 0.1);  // 4.685 x 0.01 and a little for the outliers
}

TEST(MinimizeRobustly, DoesNotDependOnTheUnitsOfTheUnknowns) {
  Curve one = curve_with_outliers();
  Curve other = curve_with_outliers();
  other.unit = 1024.0;
  static_cast<void>(minimize_robustly(one.problem(), {.gate = 20.0}));
  static_cast<void>(minimize_robustly(other.problem(), {.gate = 20.0}));
  EXPECT_EQ(one.state[0], other.state[0]);
  EXPECT_EQ(one.state[1], 1024.0 * other.state[1]);
}

TEST(MinimizeRobustly, KeepsAnUnknownThatNoResidualDependsOn) {
  Curve curve = curve_with_outliers();
  curve.unit = 0.0;
  curve.state = {0.5, 42.0};
  for (double& y : curve.y)
    y += 2.0;
  static_cast<void>(minimize_robustly(curve.problem(), {.gate = 20.0}));
  EXPECT_EQ(curve.state[1], 42.0);
  EXPECT_NEAR(curve.state[0], 0.7, 0.003);
}

TEST(MinimizeRobustly, StopsWhenTooFewResidualsAreLeft) {
  Curve curve = curve_with_outliers();
  curve.state = {0.0, 500.0};
  const auto result = minimize_robustly(curve.problem(), {.gate = 1.0});
  EXPECT_EQ(result.iterations, 0);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(curve.state[1], 500.0);
}

TEST(MinimizeRobustly, TakesAtMostAsManyIterationsAsItMay) {
  Curve curve = curve_with_outliers();
  const auto result = minimize_robustly(curve.problem(), {.gate = 20.0, .max_iterations = 2});
  EXPECT_EQ(result.iterations, 2);
  EXPECT_FALSE(result.converged);
}

TEST(GaussNewtonOptions, RefusesValuesOutOfRange) {
  EXPECT_THROW(GaussNewtonOptions{}.check(), Error);
  EXPECT_THROW((GaussNewtonOptions{.gate = 1.0, .min_gate = -1.0}.check()), Error);
  EXPECT_THROW((GaussNewtonOptions{.gate = 1.0, .max_iterations = 0}.check()), Error);
  EXPECT_THROW((GaussNewtonOptions{.gate = 1.0, .tolerance = 0.0}.check()), Error);
  EXPECT_THROW((GaussNewtonOptions{.gate = 1.0, .damping = -1.0}.check()), Error);
  EXPECT_NO_THROW((GaussNewtonOptions{.gate = 1.0}.check()));
}

}  // namespace
}  // namespace frangia
