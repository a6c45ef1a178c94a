#include "frangia/registration/internal/assess_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/internal/state_motions.h"
#include "frangia/registration/internal/turntable_bundle.h"

namespace frangia {
namespace {

/// How far the pairs disagree, over their noise and over what the places add to it.
void assess_disagreement(RegistrationReport& report,
                         const BundleSums& sums,
                         const Eigen::VectorXd& sigma) {
  constexpr std::size_t kFewest = 50;  // pairs: fewer are chance, such as edges
  const std::size_t count = sums.distances_mm.size();
  if (count < kFewest) return;
  report.disagreement_mm = static_cast<double>(median(sums.distances_mm));
  report.disagreement_over_noise = static_cast<double>(median(sums.over_sigma)) / kMedianOfNormal;
  // The variance that the places add to a pair, over that of its noise; the mean of all pairs.
  const double added = sums.hessian.diagonal().dot(sigma.cwiseAbs2()) / static_cast<double>(count);
  report.disagreement_over_sigma = report.disagreement_over_noise / std::sqrt(1.0 + added);
}

/// The information of the pairs on the unknowns: H C^-1 H with C the covariance of their gradient.
/// It is that of the noise that their distances show, and of an error that each region of a view
/// has by itself and that all of its pairs repeat, also those in which it is the target.
Eigen::MatrixXd information_of(const Bundle& bundle,
                               const BundleSums& sums,
                               const Eigen::VectorXd& sigma) {
  const double excess =
      std::max(1.0, static_cast<double>(median(sums.over_sigma)) / kMedianOfNormal);
  const double region_mm = shared_error_mm(bundle, sums) / std::sqrt(2.0);  // of either view
  const Eigen::VectorXd unit = sigma.unaryExpr([](double s) { return s > 0.0 ? s : 1.0; });
  const Eigen::MatrixXd hessian = scaled(sums.hessian, unit);
  const Eigen::MatrixXd repeated = 2.0 * region_mm * (unit.asDiagonal() * sums.region_gradients);
  Eigen::MatrixXd covariance = excess * excess * hessian + product_transposed(repeated, repeated);
  covariance.diagonal().array() += 1e-12 * covariance.trace();
  const Eigen::MatrixXd information =
      product(hessian, solve_symmetric_columns(covariance, hessian));
  return scaled(0.5 * (information + information.transpose()), unit.cwiseInverse());
}

/// The information of points that several views measured.
Eigen::MatrixXd information_of_ties(const Bundle& bundle) {
  const TieSums ties = sum_ties(bundle.ties, bundle.state);
  return ties.hessian / std::pow(ties.excess(), 2);
}

/// The standard deviations of the rig's own turntable, at least as large as its values differ from
/// those that the views fit, which contradict a smaller one.
TurntableSigma as_found(const TurntableSigma& stated, const Bundle& bundle) {
  const Eigen::VectorXd moved = deviation(bundle.state, bundle.given);
  const auto rms = [](const auto& some) {
    return some.norm() / std::sqrt(static_cast<double>(some.size()));
  };
  const auto angles = static_cast<Eigen::Index>(bundle.state.angles_rad.size()) - 1;
  TurntableSigma found = stated;
  found.axis_rad = std::max(found.axis_rad, rms(moved.head<2>()));
  found.point_mm = std::max(found.point_mm, rms(moved.segment<2>(2)));
  found.angle_rad = std::max(found.angle_rad, rms(moved.segment(4, angles)));
  return found;
}

}  // namespace

double shared_error_mm(const Bundle& bundle, const BundleSums& sums) {
  constexpr std::size_t kFewest = 200;  // pairs of a region: their noise must not count
  std::vector<float> means_mm;
  for (const PairTally& region : sums.regions) {
    if (region.agree >= kFewest) means_mm.push_back(static_cast<float>(std::abs(region.mean_mm())));
  }
  const auto regions = static_cast<double>(means_mm.size());
  // The unknowns have been fitted to the same distances.
  const double left = regions - static_cast<double>(bundle.state.unknowns());
  if (left < 1.0) return bundle.systematic_mm;
  return static_cast<double>(median(std::move(means_mm))) / kMedianOfNormal *
         std::sqrt(regions / left);
}

void assess_places(RegistrationReport& report,
                   const Bundle& bundle,
                   const BundleSums& sums,
                   const RegisterOptions& options,
                   Overlap overlap,
                   const Eigen::VectorXd& offset) {
  const double distance_mm = bundle.prior_sigma[2] / options.relative_shift_sigma;
  report.sigma = sigma_of(report.given, options, distance_mm);
  report.rests_on_rig = overlap == Overlap::SaysNothing;
  TableState state = bundle.state;
  state.table = nearest_to(report.given, state.table);
  const bool moved = overlap == Overlap::Determines && !report.kept_rig;
  const Eigen::VectorXd sigma =
      sigmas_of(state, moved ? as_found(report.sigma, bundle) : report.sigma, bundle.prior_sigma);
  Eigen::MatrixXd information;
  if (overlap == Overlap::Determines)
    information = information_of(bundle, sums, bundle.prior_sigma);
  if (!bundle.ties.empty()) {
    const Eigen::MatrixXd of_ties = information_of_ties(bundle);
    information = information.size() > 0 ? Eigen::MatrixXd(information + of_ties) : of_ties;
  }
  report.motions = state_motions(state, sigma, information, offset);
  if (report.rests_on_rig) assess_disagreement(report, sums, sigma);
}

}  // namespace frangia
