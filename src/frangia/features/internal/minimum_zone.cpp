#include "frangia/features/internal/minimum_zone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Steps of the free parameters -> steps of all parameters of `moved`.
Eigen::MatrixXd directions_of(const Shape& shape, ZoneFreedom freedom) {
  const Eigen::Index count = parameter_count(shape.kind);
  if (freedom == ZoneFreedom::All) return Eigen::MatrixXd::Identity(count, count);
  const Eigen::Index radius = size_parameter(shape.kind);
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(count, 3);
  if (shape.kind == ShapeKind::Sphere) {
    // Across its axis, which the caller has chosen.
    const Eigen::Vector3d first = shape.axis.unitOrthogonal();
    directions.col(0).head<3>() = first;
    directions.col(1).head<3>() = shape.axis.cross(first);
  } else {
    directions(0, 0) = 1.0;
    directions(1, 1) = 1.0;
  }
  directions(radius, 2) = 1.0;
  return directions;
}

}  // namespace

double minimum_zone_width(const Shape& start,
                          const std::vector<Eigen::Vector3d>& points_mm,
                          ZoneFreedom freedom) {
  require(is_surface(start.kind) && start.kind != ShapeKind::Torus,
          "a minimum zone is that of a plane, cylinder, cone or sphere");
  constexpr int kMostFits = 20;
  constexpr double kSettled = 1e-9;  // of the width
  const auto count = static_cast<Eigen::Index>(points_mm.size());
  Shape shape = start;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostFits; ++i) {
    const Eigen::MatrixXd directions = directions_of(shape, freedom);
    Eigen::MatrixXd slopes(count, directions.cols());
    Eigen::VectorXd distances(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const ShapeDistance at = distance_to(shape, points_mm[static_cast<std::size_t>(k)]);
      distances[k] = at.distance_mm;
      slopes.row(k) =
          -(at.derivatives.head(directions.rows()).transpose() * directions);  // A p ~ distances
    }
    const double width = distances.maxCoeff() - distances.minCoeff();
    if (!(width < best * (1.0 - kSettled))) break;
    best = width;
    if (count <= directions.cols()) break;
    const ChebyshevFit fit = chebyshev_fit(slopes, distances);
    shape = moved(shape, directions * fit.parameters);
  }
  return best;
}

namespace {

/// The linear program max c y with M y = e_last, y >= 0, whose dual is the fit. Column (i, s) is
/// (s a_i, 1) with cost s b_i, for s = 1 and -1; columns of the start are unit vectors that cost
/// more than any fit is worth.
class DualSimplex {
 public:
  DualSimplex(const Eigen::MatrixXd& a, const Eigen::VectorXd& b)
      : a_(a), b_(b), size_(a.cols() + 1), penalty_(-1e6 * (b.cwiseAbs().maxCoeff() + 1e-300)) {
    basis_ = Eigen::MatrixXd::Identity(size_, size_);
    cost_ = Eigen::VectorXd::Constant(size_, penalty_);
  }

  ChebyshevFit solve() {
    constexpr int kMostSteps = 2000;
    ChebyshevFit fit;
    for (int step = 0; step < kMostSteps; ++step) {
      const Eigen::PartialPivLU<Eigen::MatrixXd> lu(basis_);
      // The multipliers of the constraints are the parameters and the largest residual.
      const Eigen::VectorXd multipliers = lu.transpose().solve(cost_);
      fit.parameters = multipliers.head(size_ - 1);
      fit.largest = multipliers[size_ - 1];
      const Eigen::VectorXd residuals = b_ - a_ * fit.parameters;
      Eigen::Index worst = 0;
      const double violation = residuals.cwiseAbs().maxCoeff(&worst) - fit.largest;
      if (violation <= 1e-9 * (std::abs(fit.largest) + 1e-6 * b_.cwiseAbs().maxCoeff())) {
        fit.converged = true;
        break;
      }
      if (!exchange(lu, worst, residuals[worst] > 0.0 ? 1.0 : -1.0)) break;
    }
    fit.largest = (b_ - a_ * fit.parameters).cwiseAbs().maxCoeff();
    return fit;
  }

 private:
  /// Brings a column into the basis for the one that reaches zero first. False: none does.
  bool exchange(const Eigen::PartialPivLU<Eigen::MatrixXd>& lu, Eigen::Index point, double sign) {
    Eigen::VectorXd column(size_);
    column << sign * a_.row(point).transpose(), 1.0;
    const Eigen::VectorXd direction = lu.solve(column);
    const Eigen::VectorXd values = lu.solve(Eigen::VectorXd::Unit(size_, size_ - 1));
    Eigen::Index leaving = -1;
    double least = 0.0;
    for (Eigen::Index i = 0; i < size_; ++i) {
      if (!(direction[i] > 1e-11)) continue;
      const double ratio = std::max(0.0, values[i]) / direction[i];
      // Of equal ratios the cheapest column leaves, so that those of the start go first.
      const bool better = leaving < 0 || ratio < least - 1e-14 ||
                          (ratio < least + 1e-14 && cost_[i] < cost_[leaving]);
      if (!better) continue;
      least = ratio;
      leaving = i;
    }
    if (leaving < 0) return false;
    basis_.col(leaving) = column;
    cost_[leaving] = sign * b_[point];
    return true;
  }

  const Eigen::MatrixXd& a_;
  const Eigen::VectorXd& b_;
  Eigen::Index size_;
  double penalty_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd cost_;
};

}  // namespace

ChebyshevFit chebyshev_fit(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  // Columns of one size, so that one tolerance serves all.
  Eigen::VectorXd scale = a.cwiseAbs().colwise().maxCoeff().transpose();
  for (double& one : scale)
    if (!(one > 0.0)) one = 1.0;
  const Eigen::MatrixXd scaled = a * scale.cwiseInverse().asDiagonal();
  ChebyshevFit fit = DualSimplex(scaled, b).solve();
  fit.parameters = fit.parameters.cwiseQuotient(scale);
  return fit;
}

}  // namespace frangia
