#include "frangia/calibrate/internal/solve_quietly.h"

#include <array>
#include <string>

#include <ceres/ceres.h>
#include <glog/logging.h>
#include <gtest/gtest.h>

namespace frangia {
namespace {

/// Two unknowns that do one thing, too steeply for the solver's damping.
struct OneSumOfTwo {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = T(1e30) * (x[0] + x[1]);
    return true;
  }
};

ceres::Solver::Options one_step() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 3;
  options.jacobi_scaling = false;  // it would bring the slopes back to 1
  return options;
}

void add_sum(ceres::Problem& problem, std::array<double, 2>& x) {
  // NOLINTNEXTLINE(*-owning-memory): the problem owns it
  auto* const cost = new ceres::AutoDiffCostFunction<OneSumOfTwo, 1, 2>(new OneSumOfTwo);
  problem.AddResidualBlock(cost, nullptr, x.data());
}

TEST(SolveQuietly, SaysNothingWhereCeresWarnsOfAFactorization) {
  std::array<double, 2> x{1.0, 1.0};
  ceres::Problem loud;
  add_sum(loud, x);
  ceres::Solver::Options silent = one_step();
  silent.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ::testing::internal::CaptureStderr();
  ceres::Solve(silent, &loud, &summary);
  // Else this test says nothing: Ceres no longer warns, and solve_quietly can go.
  EXPECT_NE(::testing::internal::GetCapturedStderr(), "");

  const int level = FLAGS_minloglevel;
  ceres::Problem quiet;
  add_sum(quiet, x);
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(solve_quietly(one_step(), quiet).termination_type, summary.termination_type);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(FLAGS_minloglevel, level);
}

}  // namespace
}  // namespace frangia
