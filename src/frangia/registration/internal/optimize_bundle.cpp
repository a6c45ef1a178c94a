#include "frangia/registration/internal/optimize_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/solve_symmetric.h"
#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

/// How far the state is from the given one, in the unknowns.
Eigen::VectorXd deviation_from_prior(const Bundle& bundle) {
  const Eigen::Matrix<double, 3, 2> sides = perpendicular_directions(bundle.state.table);
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
double effective_weight(const Bundle& bundle, const BundleSums& sums) {
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

SurfelLists pick_all_surfels(const std::vector<SurfelMap>& maps, std::size_t count) {
  SurfelLists surfels;
  for (const SurfelMap& map : maps)
    surfels.push_back(pick_surfels(map, count));
  return surfels;
}

BundleSums sum(const Bundle& bundle, const SurfelLists& surfels) {
  // However badly all fits, what lies many sigmas before a surface is before it.
  constexpr double kFreeSpaceMargin = 3.0;
  const double free_space_margin_mm =
      std::min(bundle.gate_mm, kFreeSpaceMargin * bundle.min_gate_mm);
  return sum_bundle(surfels,
                    bundle.maps,
                    bundle.model,
                    bundle.state,
                    {bundle.gate_mm, free_space_margin_mm, bundle.left_out});
}

void optimize_bundle(Bundle& bundle,
                     const SurfelLists& surfels,
                     int max_iterations,
                     const Run& run) {
  const Eigen::VectorXd prior = bundle.prior_sigma.cwiseAbs2().cwiseInverse();
  for (int i = 0; i < max_iterations; ++i) {
    run.check();
    const BundleSums sums = sum(bundle, surfels);
    const double weight = effective_weight(bundle, sums);
    Eigen::MatrixXd hessian = weight * sums.hessian;
    hessian.diagonal() += prior;
    const Eigen::VectorXd slope =
        weight * sums.gradient + prior.cwiseProduct(deviation_from_prior(bundle));
    const Eigen::VectorXd step = -solve_symmetric(hessian, slope);
    bundle.state = apply_update(bundle.state, step);
    ++bundle.iterations;
    constexpr double kTukey = 4.685 * 1.4826;  // sigmas, in medians
    const double gate = std::max(bundle.min_gate_mm, kTukey * median(sums.distances_mm));
    const bool gate_converged = gate > 0.9 * bundle.gate_mm;
    bundle.gate_mm = std::min(bundle.gate_mm, gate);
    if (gate_converged && step.dot(hessian * step) < 1e-4) break;
  }
}

namespace {

constexpr double kWellDetermined = 9.0;  // three times better than before

/// What the pairs say beside the prior, in units of the prior's: 1 is as much.
SymmetricEigen<Eigen::Dynamic> information_gain(const Bundle& bundle, const BundleSums& sums) {
  const Eigen::MatrixXd gain =
      effective_weight(bundle, sums) *
      (bundle.prior_sigma.asDiagonal() * sums.hessian * bundle.prior_sigma.asDiagonal());
  return symmetric_eigen(gain);
}

/// The standard deviation of the axis along the way in which it is known least, at the rim of a
/// part.
double axis_sigma_mm(const SymmetricEigen<Eigen::Dynamic>& gain,
                     const Eigen::VectorXd& prior_sigma) {
  constexpr double kArm_mm = 30.0;  // how far from the axis a part reaches
  const Eigen::Vector4d to_mm(kArm_mm, kArm_mm, 1.0, 1.0);
  const Eigen::Vector4d scales = to_mm.cwiseProduct(prior_sigma.head<4>());
  Eigen::MatrixXd of_axis = Eigen::MatrixXd::Zero(4, 4);
  for (Eigen::Index i = 0; i < gain.values.size(); ++i) {
    const Eigen::Vector4d way = scales.cwiseProduct(gain.vectors.col(i).head<4>());
    of_axis += way * way.transpose() / (1.0 + std::max(0.0, gain.values[i]));
  }
  return std::sqrt(symmetric_eigen(of_axis).values[3]);
}

}  // namespace

void assess_observability(RegistrationReport& report,
                          const Bundle& bundle,
                          const BundleSums& sums) {
  const auto gain = information_gain(bundle, sums);
  report.weakest = std::sqrt(1.0 + std::max(0.0, gain.values[0]));
  report.condition =
      std::sqrt((1.0 + gain.values.tail<1>()[0]) / (1.0 + std::max(0.0, gain.values[0])));
  report.axis_sigma_mm = axis_sigma_mm(gain, bundle.prior_sigma);
  const auto angles = static_cast<Eigen::Index>(bundle.state.angles_rad.size()) - 1;
  std::array<double, 3> undetermined{};  // tilt, shift, angles
  for (Eigen::Index i = 0; i < gain.values.size() && gain.values[i] < kWellDetermined; ++i) {
    const Eigen::VectorXd direction = gain.vectors.col(i).cwiseAbs2();
    undetermined[0] += direction.head<2>().sum();
    undetermined[1] += direction.segment<2>(2).sum();
    undetermined[2] += direction.segment(4, angles).sum();
  }
  if (undetermined[0] > 0.5) report.undetermined.emplace_back("the tilt of the axis");
  if (undetermined[1] > 0.5) report.undetermined.emplace_back("the position of the axis");
  if (undetermined[2] > 0.5) report.undetermined.emplace_back("the angles of the views");
}

}  // namespace frangia
