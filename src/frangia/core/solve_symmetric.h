#pragma once

#include <Eigen/Core>

namespace frangia {

/// x of `matrix` x = `right`, as normal equations want it.
///
/// shape    n x n, symmetric and positive definite; its lower triangle alone is read
/// source   Cholesky's L D L^T with pivots, by Eigen; compiled once, for it takes long
[[nodiscard]] Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix,
                                              const Eigen::VectorXd& right);

}  // namespace frangia
