#include "frangia/features/fit_points.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/features/fit_shape.h"
#include "frangia/features/shape_uncertainty.h"

namespace frangia {
namespace {

Eigen::Vector3d mean_of(const FeaturePoints& points, std::span<const std::uint32_t> chosen) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : chosen)
    sum += points.points_mm[i];
  return sum / static_cast<double>(chosen.size());
}

/// Direction in which the vectors vary least.
template <typename Vector>
Eigen::Vector3d narrowest(std::span<const std::uint32_t> chosen, const Vector& vector) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : chosen) {
    const Eigen::Vector3d v = vector(i);
    moments += v * v.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(0);
}

/// Centre and radius of the sphere, or of the circle about the origin's plane for flat points, by
/// linear least squares: |p|^2 = 2 c.p + (r^2 - |c|^2).
template <typename Vector>
void fit_round(std::span<const std::uint32_t> chosen,
               int dimensions,
               const Vector& vector,
               Shape& shape) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(dimensions + 1, dimensions + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(dimensions + 1);
  for (const std::uint32_t i : chosen) {
    const Eigen::VectorXd p = vector(i);
    Eigen::VectorXd row(dimensions + 1);
    row << 2.0 * p, 1.0;
    normal += row * row.transpose();
    right += row * p.squaredNorm();
  }
  const Eigen::VectorXd found = normal.completeOrthogonalDecomposition().solve(right);
  const Eigen::VectorXd center = found.head(dimensions);
  shape.center_mm.head(dimensions) = center;
  shape.radius_mm = std::sqrt(std::max(found[dimensions] + center.squaredNorm(), 1e-12));
}

Shape start_of(const FeaturePoints& points, std::span<const std::uint32_t> chosen, ShapeKind kind) {
  const Eigen::Vector3d mean = mean_of(points, chosen);
  const auto place = [&](std::uint32_t i) -> Eigen::Vector3d { return points.points_mm[i] - mean; };
  Shape shape;
  shape.kind = kind;
  if (kind == ShapeKind::Plane) {
    shape.axis = narrowest(chosen, place);
    shape.center_mm = mean;
    return shape;
  }
  if (kind == ShapeKind::Sphere) {
    fit_round(
        chosen, 3, [&](std::uint32_t i) -> Eigen::VectorXd { return place(i); }, shape);
    shape.center_mm += mean;
    return shape;
  }
  // The normals of a cylinder lie in the plane across its axis.
  shape.axis = narrowest(chosen, [&](std::uint32_t i) { return points.normals[i]; });
  const Eigen::Matrix3d across =
      Eigen::Quaterniond::FromTwoVectors(shape.axis, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  fit_round(
      chosen,
      2,
      [&](std::uint32_t i) -> Eigen::VectorXd { return (across * place(i)).head<2>(); },
      shape);
  shape.center_mm = mean + across.transpose() * shape.center_mm;
  return shape;
}

double median_residual(const FeaturePoints& points,
                       std::span<const std::uint32_t> chosen,
                       const Shape& shape) {
  std::vector<double> residuals;
  for (const std::uint32_t i : chosen)
    residuals.push_back(std::abs(distance_to(shape, points.points_mm[i]).distance_mm));
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
}

}  // namespace

Feature fit_points(const FeaturePoints& points,
                   std::span<const std::uint32_t> chosen,
                   ShapeKind kind,
                   const Run& run) {
  require(kind == ShapeKind::Plane || kind == ShapeKind::Cylinder || kind == ShapeKind::Sphere,
          "a plane, a cylinder or a sphere is fitted to chosen points");
  const auto least = static_cast<std::size_t>(2 * parameter_count(kind));
  require(chosen.size() >= least,
          fmt::format("a {} needs at least {} measured points; select more of its surface",
                      name_of(kind),
                      least)
              .c_str());
  const Shape start = start_of(points, chosen, kind);
  constexpr double kMedians = 5.0;
  const double scale = (points.points_mm[chosen.front()] - points.points_mm[chosen.back()]).norm();
  ShapeFitOptions options;
  options.gate_mm =
      std::max(kMedians * median_residual(points, chosen, start), 1e-9 * (1.0 + scale));
  Feature feature;
  feature.fit = fit_shape(points, chosen, start, options, run);
  require(feature.fit.converged,
          fmt::format("the selected points do not determine a {}; select more of its surface",
                      name_of(kind))
              .c_str());
  feature.uncertainty = known_uncertainty(points, shape_uncertainty(points, chosen, feature.fit));
  feature.vertices.assign(chosen.begin(), chosen.end());
  return feature;
}

}  // namespace frangia
