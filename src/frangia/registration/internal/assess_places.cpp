#include "frangia/registration/internal/assess_places.h"

#include <cmath>
#include <cstddef>

#include "frangia/core/median.h"
#include "frangia/registration/internal/state_motions.h"

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

}  // namespace

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
  const Eigen::VectorXd sigma = sigmas_of(state, report.sigma, bundle.prior_sigma);
  Eigen::MatrixXd information;
  if (overlap == Overlap::Determines) information = effective_weight(bundle, sums) * sums.hessian;
  report.motions = state_motions(state, sigma, information, offset);
  if (report.rests_on_rig) assess_disagreement(report, sums, sigma);
}

}  // namespace frangia
