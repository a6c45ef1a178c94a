#include "frangia/core/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace frangia {
namespace {

template <int n>
SymmetricEigen<n> eigen_of(const Eigen::Matrix<double, n, n>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& matrix) {
  return eigen_of<3>(matrix);
}

SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix) {
  return eigen_of<Eigen::Dynamic>(matrix);
}

}  // namespace frangia
