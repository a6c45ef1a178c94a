#include "frangia/core/solve_symmetric.h"

#include <Eigen/Cholesky>

namespace frangia {

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Eigen::MatrixXd solve_symmetric_columns(const Eigen::MatrixXd& matrix,
                                        const Eigen::MatrixXd& right) {
  return matrix.ldlt().solve(right);
}

}  // namespace frangia
