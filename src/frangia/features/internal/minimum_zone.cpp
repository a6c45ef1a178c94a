#include "frangia/features/internal/minimum_zone.h"

#include <algorithm>
#include <limits>

#include "frangia/core/error.h"
#include "frangia/features/internal/chebyshev_fit.h"

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

}  // namespace frangia
