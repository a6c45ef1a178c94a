#pragma once

#include <Eigen/Core>

namespace frangia {

/// A linear fit whose largest residual is as small as possible.
struct ChebyshevFit {
  Eigen::VectorXd parameters;  ///< p, which minimizes the largest |A p - b|
  double largest = 0.0;        ///< that largest residual
  bool converged = false;      ///< false: the iterations ended before; p is worse than the best
};

/// Minimizes the largest residual |A p - b|, by the revised simplex method on the dual linear
/// program: each iteration exchanges one of the points that hold the fit for the one with the
/// largest residual.
///
/// @shape    A: m x n with m > n; b: m
/// @source   Cheney 1966, Introduction to Approximation Theory, the exchange method; Bland 1977
[[nodiscard]] ChebyshevFit chebyshev_fit(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace frangia
