#pragma once

#include <Eigen/Core>

namespace frangia {

/// Inverse of the normal matrix over the directions that the data determines.
struct NormalInverse {
  Eigen::MatrixXd covariance;
  Eigen::VectorXd open;  ///< share of each parameter that lies in directions left open, 0 to 1
};

/// Inverts a normal matrix; in parameters scaled to unit diagonal, a direction whose eigenvalue is
/// below `least` of the largest is open and left out of the covariance.
[[nodiscard]] NormalInverse invert_normal(const Eigen::MatrixXd& normal, double least);

}  // namespace frangia
