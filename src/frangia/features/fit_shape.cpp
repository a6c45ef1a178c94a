#include "frangia/features/fit_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/features/internal/weighted_sums.h"
#include "frangia/geometry/robust_gauss_newton.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kFitChunk = 4096;

ShapeSums sums_at(const FeaturePoints& points,
                  std::span<const std::uint32_t> chosen,
                  const Shape& shape,
                  const PointWeights& weights,
                  double gate_mm,
                  bool robust,
                  const Run& run) {
  if (chosen.size() <= kFitChunk) {
    ShapeSums sums;
    for (const std::uint32_t point : chosen)
      add_point(sums, points, point, shape, weights, gate_mm, robust);
    return sums;
  }
  std::vector<ShapeSums> parts((chosen.size() + kFitChunk - 1) / kFitChunk);
  interruptible_chunks(chosen.size(), kFitChunk, run, [&](std::size_t begin, std::size_t end) {
    ShapeSums part;
    for (std::size_t i = begin; i < end; ++i)
      add_point(part, points, chosen[i], shape, weights, gate_mm, robust);
    parts[begin / kFitChunk] = part;
  });
  ShapeSums sums;
  for (const ShapeSums& part : parts)
    sums.add(part);
  return sums;
}

/// The median of the absolute residuals within the gate, of a few thousand points.
double median_residual(const FeaturePoints& points,
                       std::span<const std::uint32_t> chosen,
                       const Shape& shape,
                       double gate_mm) {
  constexpr std::size_t kEnough = 4000;
  const std::size_t step = std::max<std::size_t>(1, chosen.size() / kEnough);
  std::vector<double> residuals;
  residuals.reserve(chosen.size() / step + 1);
  for (std::size_t i = 0; i < chosen.size(); i += step) {
    const double r = std::abs(distance_to(shape, points.points_mm[chosen[i]]).distance_mm);
    if (r < gate_mm) residuals.push_back(r);
  }
  return median_in_place(std::span<double>(residuals));
}

/// The same shape with its center amid the points, where its parameters are least correlated.
Shape recentered(Shape shape, const FeaturePoints& points, std::span<const std::uint32_t> chosen) {
  if (shape.kind == ShapeKind::Sphere || shape.kind == ShapeKind::Torus) return shape;
  if (shape.kind == ShapeKind::Plane) {
    Vector3d mean = Vector3d::Zero();
    for (const std::uint32_t point : chosen)
      mean += points.points_mm[point] - shape.center_mm;
    mean /= static_cast<double>(std::max<std::size_t>(1, chosen.size()));
    shape.center_mm += mean - mean.dot(shape.axis) * shape.axis;
    return shape;
  }
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const std::uint32_t point : chosen) {
    const double along = (points.points_mm[point] - shape.center_mm).dot(shape.axis);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  if (!(high >= low)) return shape;
  const double along = 0.5 * (low + high);
  shape.center_mm += along * shape.axis;
  if (shape.kind == ShapeKind::Cone) shape.radius_mm += along * std::tan(shape.half_angle_rad);
  return shape;
}

bool is_valid(const Shape& shape) {
  const bool finite = shape.center_mm.allFinite() && shape.axis.allFinite() &&
                      std::isfinite(shape.radius_mm + shape.half_angle_rad + shape.tube_radius_mm);
  if (!finite) return false;
  if (shape.kind == ShapeKind::Plane) return true;
  if (shape.kind == ShapeKind::Torus) return shape.radius_mm > 0.0 && shape.tube_radius_mm > 0.0;
  return shape.radius_mm > 0.0;
}

}  // namespace

ShapeFit fit_shape(const FeaturePoints& points,
                   std::span<const std::uint32_t> chosen,
                   const Shape& start,
                   const ShapeFitOptions& options,
                   const Run& run) {
  require(is_surface(start.kind), "lines and circles are not fitted to points of a surface");
  require(options.gate_mm > 0.0, "ShapeFitOptions: gate_mm must be above 0");
  const int count = parameter_count(start.kind);
  const PointWeights weights(points, chosen);
  ShapeFit fit;
  fit.shape = recentered(start, points, chosen);
  RobustProblem problem;
  problem.linearize = [&](double gate) {
    // Without robust weights the gate stays: every point within it counts fully.
    const double limit = options.robust ? gate : options.gate_mm;
    const ShapeSums sums = sums_at(points, chosen, fit.shape, weights, limit, options.robust, run);
    Linearization at;
    at.hessian = sums.hessian.topLeftCorner(count, count);
    at.gradient = sums.gradient.head(count);
    at.median_residual = options.robust ? median_residual(points, chosen, fit.shape, limit) : limit;
    at.unit_weight_sigma = weights.unit_weight_sigma();
    if (at.unit_weight_sigma == 0.0 && sums.count > 0)
      at.unit_weight_sigma = std::sqrt(sums.squares / static_cast<double>(sums.count));
    at.solvable = sums.count > static_cast<std::size_t>(count) && at.hessian.allFinite() &&
                  is_valid(fit.shape);
    return at;
  };
  problem.update = [&](const Eigen::VectorXd& step) { fit.shape = moved(fit.shape, step); };
  GaussNewtonOptions newton;
  newton.gate = options.gate_mm;
  newton.min_gate = 1e-6 * options.gate_mm;
  newton.max_iterations = options.max_iterations;
  newton.tolerance = 1e-3;
  newton.damping = 1e-12;
  const GaussNewtonResult result = minimize_robustly(problem, newton, run);
  fit.converged = result.iterations > 0 && is_valid(fit.shape);
  if (!fit.converged) return fit;
  fit.shape = recentered(fit.shape, points, chosen);
  const double gate = options.robust ? result.gate : options.gate_mm;
  const ShapeSums sums = sums_at(points, chosen, fit.shape, weights, gate, options.robust, run);
  fit.points = sums.count;
  fit.rms_mm = sums.count > 0 ? std::sqrt(sums.squares / static_cast<double>(sums.count)) : 0.0;
  fit.form_mm = sums.high - sums.low;
  fit.gate_mm = gate;
  return fit;
}

}  // namespace frangia
