#include "frangia/registration/internal/widen_drift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

/// Factors of the standard deviations of a group that is not as stated, and of all groups: a rig of
/// which everything is far off is less to be expected than one with a wrong lens.
constexpr std::array<double, 3> kWidenings{3.0, 10.0, 30.0};
constexpr double kAllWider = 3.0;
/// Natural logarithm of the odds that one of the groups is not, before the surfaces are seen.
constexpr double kDriftNotAsStated = -6.9;

/// Natural logarithm of the evidence of a prior of w, over that of no change at all.
double log_evidence(const DriftEvidence& about_zero, const Eigen::MatrixXd& factor) {
  Eigen::MatrixXd hessian = congruence(factor, about_zero.hessian);
  hessian.diagonal().array() += 1.0;
  const Cholesky factors(hessian);
  const Eigen::VectorXd gradient = transposed_product(factor, about_zero.gradient);
  return 0.5 * (gradient.dot(factors.solve(gradient)) - factors.log_determinant());
}

}  // namespace

Eigen::VectorXd widening_by_evidence(const DriftHypotheses& hypotheses,
                                     const DriftEvidence& evidence,
                                     const Eigen::VectorXd& w) {
  const DriftEvidence about_zero{evidence.hessian,
                                 evidence.gradient - product(evidence.hessian, w)};
  const Eigen::VectorXd none = Eigen::VectorXd::Ones(hypotheses.parameters);
  std::vector<Eigen::VectorXd> widenings{none, kAllWider * none};
  const double rare =
      kDriftNotAsStated -
      std::log(static_cast<double>(1 + hypotheses.groups.size() * kWidenings.size()));
  std::vector<double> log_odds{
      log_evidence(about_zero, hypotheses.factor(none)),
      rare + log_evidence(about_zero, hypotheses.factor(kAllWider * none))};
  for (const std::vector<Eigen::Index>& group : hypotheses.groups) {
    for (const double wider : kWidenings) {
      Eigen::VectorXd widening = none;
      for (const Eigen::Index parameter : group)
        widening[parameter] = wider;
      log_odds.push_back(rare + log_evidence(about_zero, hypotheses.factor(widening)));
      widenings.push_back(std::move(widening));
    }
  }
  const double most = *std::max_element(log_odds.begin(), log_odds.end());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(hypotheses.parameters);
  double sum = 0.0;
  for (std::size_t i = 0; i < log_odds.size(); ++i) {
    const double odds = std::exp(log_odds[i] - most);
    squares += odds * widenings[i].cwiseAbs2();
    sum += odds;
  }
  return (squares / sum).cwiseSqrt();
}

}  // namespace frangia
