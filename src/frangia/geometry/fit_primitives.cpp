#include "frangia/geometry/fit_primitives.h"

#include <cmath>

#include <Eigen/Core>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {

Eigen::Hyperplane<double, 3> fit_plane(std::span<const Eigen::Vector3d> points_mm) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points_mm)
    centroid += point / static_cast<double>(points_mm.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points_mm)
    scatter += (point - centroid) * (point - centroid).transpose();
  return {Eigen::Vector3d(symmetric_eigen(scatter).vectors.col(0)), centroid};
}

namespace {

/// Solves |p|^2 = 2 c.p + (r^2 - |c|^2), which is linear in c and the bracket. The points must be
/// centred on their mean.
Sphere fit_sphere_algebraically(const Eigen::Matrix3Xd& points) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector4d row;
    row << 2.0 * points.col(i), 1.0;
    A += row * row.transpose();
    b += row * points.col(i).squaredNorm();
  }
  const Eigen::VectorXd spread = symmetric_eigen(A).values;
  if (!(spread[0] > 1e-12 * spread[3])) {
    throw Error(ErrorKind::Numeric,
                "fit_sphere: the points lie in a plane; a sphere needs points all around it");
  }
  const Eigen::Vector4d x = solve_symmetric(A, b);
  return {x.head<3>(), std::sqrt(std::max(0.0, x[3] + x.head<3>().squaredNorm())), 0.0};
}

/// Makes one Gauss-Newton step and returns its length.
double gauss_newton_step(const Eigen::Matrix3Xd& points, Sphere& sphere) {
  Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
  Eigen::Vector4d g = Eigen::Vector4d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d out = points.col(i) - sphere.center_mm;
    const double distance = out.norm();
    if (!(distance > 0.0)) continue;
    Eigen::Vector4d row;
    row << -out / distance, -1.0;
    H += row * row.transpose();
    g += row * (distance - sphere.radius_mm);
  }
  const Eigen::Vector4d step = -solve_symmetric(H, g);
  sphere.center_mm += step.head<3>();
  sphere.radius_mm += step[3];
  return step.norm();
}

}  // namespace

Sphere fit_sphere(std::span<const Eigen::Vector3d> points_mm) {
  require(points_mm.size() >= 4, "fit_sphere: a sphere needs at least four points");
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(points_mm.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points.col(i) = points_mm[static_cast<std::size_t>(i)];
  }
  const Eigen::Vector3d mean = points.rowwise().mean();
  points.colwise() -= mean;
  // Unit scale keeps the normal equations well conditioned.
  const double scale = std::sqrt(points.squaredNorm() / static_cast<double>(points.cols()));
  if (!(scale > 0.0)) throw Error(ErrorKind::Numeric, "fit_sphere: all points are the same");
  points /= scale;

  Sphere sphere = fit_sphere_algebraically(points);
  constexpr int kMaxSteps = 50;
  for (int i = 0; i < kMaxSteps && gauss_newton_step(points, sphere) > 1e-13; ++i) {
  }
  const Eigen::ArrayXd distances =
      (points.colwise() - sphere.center_mm).colwise().norm().array() - sphere.radius_mm;
  return {mean + scale * sphere.center_mm,
          scale * sphere.radius_mm,
          scale * std::sqrt(distances.square().mean())};
}

}  // namespace frangia
