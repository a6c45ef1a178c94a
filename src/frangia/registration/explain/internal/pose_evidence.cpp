#include "frangia/registration/explain/internal/pose_evidence.h"

#include <utility>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

Cholesky with_prior(Eigen::MatrixXd hessian) {
  hessian.diagonal().array() += 1.0;
  return Cholesky(hessian);
}

}  // namespace

PoseEvidence::PoseEvidence(NormalEquations data, Eigen::MatrixXd table)
    : data_(std::move(data)), table_(std::move(table)) {
  const Eigen::MatrixXd across = product(data_.hessian, table_);
  const Cholesky of_table = with_prior(transposed_product(table_, across));
  const Eigen::VectorXd gradient = transposed_product(table_, data_.gradient);
  reduced_.hessian = data_.hessian - product(across, of_table.solve_columns(across.transpose()));
  reduced_.gradient = data_.gradient - product(across, of_table.solve(gradient));
}

double PoseEvidence::table_log_odds() const {
  return log_odds(congruence(table_, data_.hessian), transposed_product(table_, data_.gradient));
}

double PoseEvidence::log_odds(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient) {
  const Cholesky factors = with_prior(hessian);
  return 0.5 * (gradient.dot(factors.solve(gradient)) - factors.log_determinant());
}

PosePosterior PoseEvidence::posterior(const Eigen::MatrixXd& own) const {
  Eigen::MatrixXd all(table_.rows(), table_.cols() + own.cols());
  all << table_, own;
  const Cholesky factors = with_prior(congruence(all, data_.hessian));
  const Eigen::VectorXd changes = -factors.solve(transposed_product(all, data_.gradient));
  PosePosterior found;
  found.motion = product(all, changes);
  // The covariance of the changes is (L L^T)^-1, and L^-T its factor.
  const Eigen::MatrixXd inverse = factors.inverse_lower().transpose();
  found.factor = product(all, inverse);
  found.table = changes.head(table_.cols());
  found.changes = changes.tail(own.cols());
  const Eigen::MatrixXd of_own = inverse.bottomRows(own.cols());
  found.changes_covariance = product_transposed(of_own, of_own);
  return found;
}

double PoseEvidence::loss(const Eigen::VectorXd& motion) const {
  return motion.dot(0.5 * product(data_.hessian, motion) + data_.gradient);
}

}  // namespace frangia
