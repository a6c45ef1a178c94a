#include "frangia/registration/internal/sum_ties.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/registration/internal/view_transfer.h"

namespace frangia {
namespace {

TableState tied_setups() {
  TableState state{{{2.0, 22.0, 400.0}, Eigen::Vector3d(0.02, -0.9, -0.42).normalized()},
                   {0.0, 1.1, 2.2, 0.0, 1.4},
                   {0, 0, 0, 1, 1},
                   {}};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(2.8, Eigen::Vector3d(0.2, 1.0, -0.5).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(10.0, 700.0, 500.0);
  state.part_poses = {pose};
  return state;
}

/// Ten points of the part that all views measured, each with its own noise.
std::vector<PointTie> ties_in(const TableState& state, double sigma_mm, std::uint64_t seed) {
  std::vector<PointTie> ties;
  const std::size_t views = state.angles_rad.size();
  for (std::uint64_t point = 0; point < 10; ++point) {
    const auto draw = [&](std::uint64_t k) { return uniform_from(hash(hash(point), k)) - 0.5; };
    const Eigen::Vector3d first(120.0 * draw(1), 80.0 * draw(2), 400.0 + 60.0 * draw(3));
    std::vector<Eigen::Vector3d> seen;
    for (std::size_t view = 0; view < views; ++view) {
      Eigen::Vector3d at = view == 0 ? first : ViewTransfer(state, 0, view).apply(first);
      for (std::uint64_t k = 0; k < 3; ++k)
        at[static_cast<Eigen::Index>(k)] +=
            sigma_mm * normal_from(hash(hash(hash(seed, point), view), k));
      seen.push_back(at);
    }
    const Eigen::Matrix3d covariance = sigma_mm * sigma_mm * Eigen::Matrix3d::Identity();
    for (std::size_t i = 0; i < views; ++i)
      for (std::size_t j = 0; j < i; ++j)
        ties.push_back(
            {i, j, seen[i], seen[j], covariance, covariance, 2.0 / static_cast<double>(views)});
  }
  return ties;
}

/// With the angle of the first view of the second setup held: the part pose of that setup can take
/// the place of it.
Eigen::MatrixXd with_angle_held(Eigen::MatrixXd hessian) {
  constexpr Eigen::Index kAngleOfView3 = 6;
  constexpr double kHeld = 1e14;
  hessian(kAngleOfView3, kAngleOfView3) += kHeld;
  return hessian;
}

TEST(SumTies, LeadsToTheTrueStateWithTheSigmaThatItsHessianStates) {
  const TableState truth = tied_setups();
  // Two tilts, two shifts, and the angles of views 1 and 2.
  constexpr Eigen::Index kOwn = 6;
  double chi_squared = 0.0;
  constexpr int kSeeds = 20;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto ties = ties_in(truth, 0.01, static_cast<std::uint64_t>(seed));
    TableState state = truth;
    for (int i = 0; i < 6; ++i) {
      const TieSums sums = sum_ties(ties, state);
      state = apply_update(state, -with_angle_held(sums.hessian).ldlt().solve(sums.gradient));
    }
    const TieSums sums = sum_ties(ties, state);
    EXPECT_LT(sums.gradient.norm(), 1e-3 * sum_ties(ties, truth).gradient.norm());
    EXPECT_NEAR(sums.chi_squared / sums.freedom, 1.0, 0.5);
    const Eigen::VectorXd away = deviation(state, truth).head(kOwn);
    const Eigen::MatrixXd covariance =
        with_angle_held(sums.hessian).inverse().topLeftCorner(kOwn, kOwn);
    chi_squared += away.dot(covariance.inverse() * away);
  }
  EXPECT_NEAR(chi_squared / (kSeeds * static_cast<double>(kOwn)), 1.0, 0.3);
}

TEST(SumTies, IsPulledByAWrongTieNoHarderThanByFourSigmas) {
  const TableState state = tied_setups();
  auto ties = ties_in(state, 0.01, 3);
  const double sound = sum_ties(ties, state).gradient.norm();
  ties[7].from_mm.x() += 5.0;
  EXPECT_LT(sum_ties(ties, state).gradient.norm(), 20.0 * sound);
}

}  // namespace
}  // namespace frangia
