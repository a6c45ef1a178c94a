#include "frangia/range/internal/phase_sample.h"

#include <algorithm>
#include <limits>

#include "frangia/core/linear_algebra.h"

namespace frangia {

void fill_missing(Eigen::MatrixXd& nodes, const std::array<int, 3>& counts) {
  const auto place_of = [&](Eigen::Index i) {
    const auto at = static_cast<int>(i);
    return Eigen::Array3i(at % counts[0], at / counts[0] % counts[1], at / (counts[0] * counts[1]));
  };
  const Eigen::MatrixXd known = nodes;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    if (known.col(i).allFinite()) continue;
    nodes.col(i).setZero();
    int nearest = std::numeric_limits<int>::max();
    for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
      const int apart = (place_of(j) - place_of(i)).square().sum();
      if (apart >= nearest || !known.col(j).allFinite()) continue;
      nearest = apart;
      nodes.col(i) = known.col(j);
    }
  }
}

Eigen::MatrixXf principal_components(const Eigen::MatrixXd& rows) {
  constexpr double kLost = 1e-4;
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(rows * rows.transpose()));
  const double most = kLost * eigen.values.sum();
  Eigen::Index first = 0;
  for (double lost = 0.0; first < eigen.values.size(); ++first) {
    lost += std::max(0.0, eigen.values[first]);
    if (lost > most) break;
  }
  const Eigen::Index kept = eigen.values.size() - first;
  return (eigen.vectors.rightCols(kept).transpose() * rows).cast<float>();
}

Eigen::MatrixXf principal_displacements(const Eigen::MatrixXd& nodes) {
  const Eigen::Index changes = nodes.rows() / 3;
  Eigen::MatrixXd rows(changes, 3 * nodes.cols());
  for (Eigen::Index i = 0; i < nodes.cols(); ++i)
    rows.middleCols(3 * i, 3) = nodes.col(i).reshaped(3, changes).transpose();
  return principal_components(rows);
}

}  // namespace frangia
