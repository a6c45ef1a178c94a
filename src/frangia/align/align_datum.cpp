#include "frangia/align/align_datum.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/align/internal/free_motions.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// Residuals of a datum, mm, and their derivatives by a rotation, times the size of the part, and a
/// translation.
struct DatumRows {
  Eigen::VectorXd residuals;
  Eigen::VectorXd sigmas;
  Rows jacobian;

  void add(double residual, double sigma, const Vector3d& turn, const Vector3d& shift) {
    const Eigen::Index row = residuals.size();
    residuals.conservativeResize(row + 1);
    sigmas.conservativeResize(row + 1);
    jacobian.conservativeResize(row + 1, 6);
    residuals[row] = residual;
    sigmas[row] = std::isfinite(sigma) ? sigma : 0.0;
    jacobian.row(row) << turn.transpose(), shift.transpose();
  }
};

Vector3d like(const Vector3d& axis, const Vector3d& other) {
  return axis.dot(other) < 0.0 ? Vector3d(-axis) : axis;
}

bool has_axis(ShapeKind kind) {
  return kind != ShapeKind::Sphere;
}

/// The point of the measured element that is compared: that of an axis which lies level with the
/// nominal center, the center otherwise.
Vector3d compared_point(const Shape& nominal, const Shape& measured) {
  if (nominal.kind != ShapeKind::Cylinder && nominal.kind != ShapeKind::Cone)
    return measured.center_mm;
  const double along = nominal.axis.dot(nominal.center_mm - measured.center_mm);
  return measured.center_mm + along / nominal.axis.dot(measured.axis) * measured.axis;
}

/// Directions along which the place of an element of this kind is determined.
std::vector<Vector3d> placed_along(const Shape& nominal) {
  if (nominal.kind == ShapeKind::Plane) return {nominal.axis};
  const Vector3d first = nominal.axis.unitOrthogonal();
  const Vector3d second = nominal.axis.cross(first);
  if (nominal.kind == ShapeKind::Cylinder || nominal.kind == ShapeKind::Cone)
    return {first, second};
  return {first, second, nominal.axis};
}

DatumRows rows_of(const Datum& datum, const Vector3d& center, double size) {
  DatumRows rows;
  const Shape& nominal = datum.nominal;
  const Vector3d axis = like(datum.measured.axis, nominal.axis);
  if (has_axis(nominal.kind)) {
    const Vector3d first = nominal.axis.unitOrthogonal();
    for (const Vector3d& side : {first, Vector3d(nominal.axis.cross(first))}) {
      rows.add(size * side.dot(axis - nominal.axis),
               size * datum.uncertainty.axis_u95_rad / kNormal95,
               axis.cross(side),
               Vector3d::Zero());
    }
  }
  const Vector3d point = compared_point(nominal, datum.measured);
  for (const Vector3d& side : placed_along(nominal)) {
    rows.add(side.dot(point - nominal.center_mm),
             datum.uncertainty.center_u95_mm / kNormal95,
             (point - center).cross(side) / size,
             side);
  }
  return rows;
}

/// A step of all unknowns: the solution, its derivatives by the residuals, and what is left free.
struct DatumStep {
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(6, 6);  ///< columns
};

/// Solves each datum in the directions that those before it leave free.
DatumStep solve(std::span<const Datum> datums, const Vector3d& center, double size) {
  constexpr double kDetermined = 0.05;  // sine of the least angle between two datums
  DatumStep step;
  Eigen::MatrixXd response(6, 0);  // of the twist to all residuals
  Eigen::VectorXd sigmas(0);
  for (const Datum& datum : datums) {
    const DatumRows rows = rows_of(datum, center, size);
    const Eigen::MatrixXd within = product(rows.jacobian, step.free);
    // Its singular values, squared, and its right singular vectors, in ascending order.
    const auto squares = symmetric_eigen(transposed_product(within, within));
    const Eigen::Index rank = (squares.values.array() > kDetermined * kDetermined).count();
    if (rank == 0) {
      throw Error(ErrorKind::Input,
                  fmt::format("datum \"{}\" determines nothing that the datums before it leave "
                              "free; choose another",
                              datum.name));
    }
    const Eigen::MatrixXd determined = squares.vectors.rightCols(rank);
    const Eigen::MatrixXd inverse =
        product_transposed(determined * squares.values.tail(rank).cwiseInverse().asDiagonal(),
                           product(within, determined));
    const Eigen::MatrixXd solver = product(step.free, inverse);
    const Eigen::Index before = response.cols();
    const Eigen::Index added = rows.residuals.size();
    response.conservativeResize(6, before + added);
    response.rightCols(added).setZero();
    Eigen::MatrixXd seen =
        product(rows.jacobian, response);  // of these residuals, after the steps so far
    seen.rightCols(added) += Eigen::MatrixXd::Identity(added, added);
    response -= product(solver, seen);
    step.twist -= product(solver, rows.residuals + product(rows.jacobian, step.twist));
    sigmas.conservativeResize(before + added);
    sigmas.tail(added) = rows.sigmas;
    step.free = product(step.free, squares.vectors.leftCols(step.free.cols() - rank));
    if (step.free.cols() == 0) break;
  }
  const Eigen::MatrixXd by_sigma = response * sigmas.asDiagonal();
  step.covariance = product_transposed(by_sigma, by_sigma);
  return step;
}

Shape moved_by(const Eigen::Isometry3d& motion, Shape shape) {
  shape.center_mm = motion * shape.center_mm;
  shape.axis = motion.linear() * shape.axis;
  return shape;
}

DatumResidual residual_of(const Datum& datum) {
  DatumResidual residual{datum.name, 0.0, 0.0};
  const Vector3d axis = like(datum.measured.axis, datum.nominal.axis);
  if (has_axis(datum.nominal.kind))
    residual.angle_rad = std::asin(std::min(1.0, axis.cross(datum.nominal.axis).norm()));
  const Vector3d away = compared_point(datum.nominal, datum.measured) - datum.nominal.center_mm;
  double square = 0.0;
  for (const Vector3d& side : placed_along(datum.nominal))
    square += std::pow(side.dot(away), 2);
  residual.distance_mm = std::sqrt(square);
  return residual;
}

}  // namespace

DatumAlignment align_to_datums(std::span<const Datum> datums,
                               const Vector3d& center_mm,
                               double size_mm) {
  require(!datums.empty() && datums.size() <= 3, "an alignment takes one to three datums");
  require(size_mm > 0.0, "align_to_datums: the size of the part must be above 0");
  std::vector<Datum> moving(datums.begin(), datums.end());
  for (const Datum& datum : moving) {
    if (datum.nominal.kind != datum.measured.kind || !is_surface(datum.nominal.kind)) {
      throw Error(ErrorKind::Input,
                  fmt::format("datum \"{}\" must be a surface, nominal and measured of one kind",
                              datum.name));
    }
  }
  DatumAlignment result;
  DatumStep step;
  constexpr int kMostSteps = 30;
  constexpr double kConverged = 1e-12;  // of the size
  for (int i = 0; i < kMostSteps; ++i) {
    step = solve(moving, center_mm, size_mm);
    const Eigen::Isometry3d motion = motion_of(step.twist, center_mm, size_mm);
    result.motion = motion * result.motion;
    for (Datum& datum : moving)
      datum.measured = moved_by(motion, datum.measured);
    if (step.twist.norm() < kConverged * size_mm) break;
  }
  for (const Datum& datum : moving)
    result.residuals.push_back(residual_of(datum));
  for (Eigen::Index i = 0; i < step.free.cols(); ++i) {
    result.free_directions.push_back(FreeMotion{step.free.col(i), center_mm, size_mm}.text());
  }
  Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Ones();
  scale.head<3>() /= size_mm;  // the rotations are times the size
  result.uncertainty.covariance = scale.asDiagonal() * step.covariance * scale.asDiagonal();
  result.uncertainty.center_mm = center_mm;
  return result;
}

}  // namespace frangia
