#include "frangia/registration/explain/internal/pose_evidence.h"

#include <utility>

#include <Eigen/Cholesky>

namespace frangia {
namespace {

Eigen::LLT<Eigen::MatrixXd> with_prior(Eigen::MatrixXd hessian) {
  hessian.diagonal().array() += 1.0;
  return Eigen::LLT<Eigen::MatrixXd>(hessian);
}

}  // namespace

PoseEvidence::PoseEvidence(NormalEquations data, Eigen::MatrixXd table)
    : data_(std::move(data)), table_(std::move(table)) {
  const Eigen::MatrixXd across = data_.hessian * table_;
  const auto of_table = with_prior(table_.transpose() * across);
  reduced_.hessian = data_.hessian - across * of_table.solve(across.transpose());
  reduced_.gradient = data_.gradient - across * of_table.solve(table_.transpose() * data_.gradient);
}

double PoseEvidence::table_log_odds() const {
  return log_odds(table_.transpose() * data_.hessian * table_, table_.transpose() * data_.gradient);
}

double PoseEvidence::log_odds(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient) {
  const auto llt = with_prior(hessian);
  const double log_determinant = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  return 0.5 * (gradient.dot(llt.solve(gradient)) - log_determinant);
}

PosePosterior PoseEvidence::posterior(const Eigen::MatrixXd& own) const {
  Eigen::MatrixXd all(table_.rows(), table_.cols() + own.cols());
  all << table_, own;
  const auto llt = with_prior(all.transpose() * data_.hessian * all);
  const Eigen::VectorXd changes = -llt.solve(all.transpose() * data_.gradient);
  PosePosterior found;
  found.motion = all * changes;
  // The covariance of the changes is (L L^T)^-1, and L^-T its factor.
  const Eigen::MatrixXd inverse =
      llt.matrixL().solve(Eigen::MatrixXd::Identity(all.cols(), all.cols())).transpose();
  found.factor = all * inverse;
  found.table = changes.head(table_.cols());
  found.changes = changes.tail(own.cols());
  const Eigen::MatrixXd of_own = inverse.bottomRows(own.cols());
  found.changes_covariance = of_own * of_own.transpose();
  return found;
}

double PoseEvidence::loss(const Eigen::VectorXd& motion) const {
  return motion.dot(0.5 * (data_.hessian * motion) + data_.gradient);
}

}  // namespace frangia
