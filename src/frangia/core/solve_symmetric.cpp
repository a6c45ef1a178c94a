#include "frangia/core/solve_symmetric.h"

#include <Eigen/Cholesky>

namespace frangia {

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

}  // namespace frangia
