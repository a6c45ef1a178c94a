#include "frangia/views/settle_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

namespace frangia {
namespace {

/// How far the state is from the given one, in the unknowns.
Eigen::VectorXd departure(const Bundle& bundle) {
  const Eigen::Matrix<double, 3, 2> sides = across(bundle.state.table);
  Eigen::VectorXd away = Eigen::VectorXd::Zero(bundle.prior_sigma.size());
  away.head<2>() = sides.transpose() * bundle.given.table.axis.cross(bundle.state.table.axis);
  away.segment<2>(2) =
      sides.transpose() * (bundle.state.table.point_mm - bundle.given.table.point_mm);
  for (std::size_t view = 1; view < bundle.state.angles_rad.size(); ++view) {
    away[static_cast<Eigen::Index>(view) + 3] =
        bundle.state.angles_rad[view] - bundle.given.angles_rad[view];
  }
  return away;
}

/// What the pairs count beside what was known before: as many fewer as have errors of their own,
/// when the error common to all pairs of two views is as given.
double worth_of(const Bundle& bundle, const BundleSums& sums) {
  const double pairs = static_cast<double>(std::max<std::size_t>(1, sums.distances_mm.size()));
  const double view_pairs = static_cast<double>(bundle.maps.size() * (bundle.maps.size() - 1));
  const double scatter = 1.4826 * median(sums.distances_mm);
  const double independent = view_pairs * std::pow(scatter / bundle.systematic_mm, 2);
  return std::min(1.0, independent / pairs);
}

}  // namespace

double median(std::vector<float> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

Spots pick_all(const std::vector<PlaneMap>& maps, std::size_t count) {
  Spots spots;
  for (const PlaneMap& map : maps)
    spots.push_back(pick_spots(map, count));
  return spots;
}

BundleSums sum(const Bundle& bundle, const Spots& spots) {
  return sum_bundle(spots, bundle.maps, bundle.lens, bundle.state, {bundle.gate_mm});
}

void settle(Bundle& bundle, const Spots& spots, int max_iterations, const Run& run) {
  const Eigen::VectorXd prior = bundle.prior_sigma.cwiseAbs2().cwiseInverse();
  for (int i = 0; i < max_iterations; ++i) {
    run.check();
    const BundleSums sums = sum(bundle, spots);
    const double worth = worth_of(bundle, sums);
    Eigen::MatrixXd hessian = worth * sums.hessian;
    hessian.diagonal() += prior;
    const Eigen::VectorXd slope = worth * sums.gradient + prior.cwiseProduct(departure(bundle));
    const Eigen::VectorXd step = -hessian.ldlt().solve(slope);
    bundle.state = moved(bundle.state, step);
    ++bundle.iterations;
    constexpr double kTukey = 4.685 * 1.4826;  // sigmas, in medians
    const double gate = std::max(bundle.floor_mm, kTukey * median(sums.distances_mm));
    const bool gate_rests = gate > 0.9 * bundle.gate_mm;
    bundle.gate_mm = std::min(bundle.gate_mm, gate);
    if (gate_rests && step.dot(hessian * step) < 1e-4) break;
  }
}

void judge(RegistrationReport& report, const Bundle& bundle, const BundleSums& sums) {
  const Eigen::MatrixXd gain =
      worth_of(bundle, sums) *
      (bundle.prior_sigma.asDiagonal() * sums.hessian * bundle.prior_sigma.asDiagonal());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gain);
  report.weakest = std::sqrt(1.0 + std::max(0.0, solver.eigenvalues()[0]));
  report.condition = std::sqrt((1.0 + solver.eigenvalues().tail<1>()[0]) /
                               (1.0 + std::max(0.0, solver.eigenvalues()[0])));
  const auto angles = static_cast<Eigen::Index>(bundle.state.angles_rad.size()) - 1;
  constexpr double kKnown = 9.0;  // three times better than before
  std::array<double, 3> open{};   // tilt, shift, angles
  for (Eigen::Index i = 0; i < solver.eigenvalues().size() && solver.eigenvalues()[i] < kKnown;
       ++i) {
    const Eigen::VectorXd direction = solver.eigenvectors().col(i).cwiseAbs2();
    open[0] += direction.head<2>().sum();
    open[1] += direction.segment<2>(2).sum();
    open[2] += direction.segment(4, angles).sum();
  }
  if (open[0] > 0.5) report.open.emplace_back("the tilt of the axis");
  if (open[1] > 0.5) report.open.emplace_back("the place of the axis");
  if (open[2] > 0.5) report.open.emplace_back("the angles of the views");
}

}  // namespace frangia
