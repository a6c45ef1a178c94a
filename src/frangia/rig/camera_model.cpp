#include "frangia/rig/camera_model.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

constexpr int kMaxIterations = 20;        // of Newton's method
constexpr double kConverged = 1e-28;      // squared normalized distance at rounding level
constexpr double kAcceptable = 1e-20;     // largest squared distance accepted as a solution
constexpr double kMinDeterminant = 1e-3;  // below it the model is about to fold back

/// The normalized points of an image row, in separate arrays per coordinate so that loops
/// vectorize.
struct RayRow {
  std::vector<double> x, y, distorted_x, distorted_y;
};

/// Performs one Newton step of the model of Brown and Conrady for a whole row; returns the largest
/// squared error before the step.
FRANGIA_VECTORIZED_WIDE double newton_step(const CameraModel& model, RayRow& row) {
  const auto [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y] = model.distortion;
  double* to_x = row.x.data();
  double* to_y = row.y.data();
  const double* from_x = row.distorted_x.data();
  const double* from_y = row.distorted_y.data();
  const auto count = static_cast<std::ptrdiff_t>(row.x.size());
  double worst = 0.0;
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double x = to_x[i];
    const double y = to_y[i];
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));
    const double off_x = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x) - from_x[i];
    const double off_y = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y - from_y[i];
    const double xx = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x;
    const double xy = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
    const double yy = radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
    const double determinant = xx * yy - xy * xy;
    const double error = off_x * off_x + off_y * off_y;
    double share = error >= kConverged ? 1.0 / determinant : 0.0;
    share = determinant > kMinDeterminant ? share : 0.0;
    to_x[i] = x - (yy * off_x - xy * off_y) * share;
    to_y[i] = y - (xx * off_y - xy * off_x) * share;
    worst = error > worst ? error : worst;
  }
  return worst;
}

Eigen::Vector2d distorted_by(const Distortion<double>& lens, const Eigen::Vector2d& normalized) {
  const auto [u, v] = lens.extended ? lens.distort<true>(normalized.x(), normalized.y())
                                    : lens.distort<false>(normalized.x(), normalized.y());
  return {u, v};
}

Eigen::Matrix2d jacobian_of(const Distortion<double>& lens, const Eigen::Vector2d& normalized) {
  const auto d = lens.extended ? lens.jacobian<true>(normalized.x(), normalized.y())
                               : lens.jacobian<false>(normalized.x(), normalized.y());
  Eigen::Matrix2d jacobian;
  jacobian << d.ux, d.uy, d.vx, d.vy;
  return jacobian;
}

Eigen::Vector2d undistorted_by(const Distortion<double>& lens, const Eigen::Vector2d& distorted) {
  Eigen::Vector2d guess = distorted;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector2d error = distorted_by(lens, guess) - distorted;
    if (error.squaredNorm() < kConverged) return guess;
    const Eigen::Matrix2d jacobian = jacobian_of(lens, guess);
    if (!(jacobian.determinant() > kMinDeterminant)) break;
    guess -= jacobian.inverse() * error;
  }
  if ((distorted_by(lens, guess) - distorted).squaredNorm() < kAcceptable) return guess;
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// `rays_of` for the model of Brown and Conrady.
Image<Eigen::Vector2f> basic_rays_of(const CameraModel& model) {
  Image<Eigen::Vector2f> rays(model.width_px, model.height_px, Uninitialized{});
  const auto width = static_cast<std::size_t>(model.width_px);
  std::vector<double> distorted_x(width);
  for (std::size_t x = 0; x < width; ++x) {
    const auto pixel = static_cast<double>(x);
    distorted_x[x] = (pixel - model.principal_point_px.x()) / model.focal_px.x();
  }
  parallel_rows(model.height_px, [&](int y) {
    const double distorted_y = (y - model.principal_point_px.y()) / model.focal_px.y();
    const std::vector<double> same_y(width, distorted_y);
    RayRow row{distorted_x, same_y, distorted_x, same_y};
    double worst = 1.0;
    for (int step = 0; step < kMaxIterations && worst >= kConverged; ++step)
      worst = newton_step(model, row);
    for (std::size_t x = 0; x < width; ++x) {
      const Eigen::Vector2d ray(row.x[x], row.y[x]);
      const Eigen::Vector2d wanted(distorted_x[x], distorted_y);
      const bool found =
          worst < kConverged || (model.distort(ray) - wanted).squaredNorm() < kAcceptable;
      rays(static_cast<int>(x), y) =
          found ? Eigen::Vector2f(ray.cast<float>()) : Eigen::Vector2f::Constant(kMissing);
    }
  });
  return rays;
}

/// `rays_of` for a model with further coefficients.
Image<Eigen::Vector2f> extended_rays_of(const CameraModel& model, const Distortion<double>& lens) {
  Image<Eigen::Vector2f> rays(model.width_px, model.height_px, Uninitialized{});
  parallel_rows(model.height_px, [&](int y) {
    for (int x = 0; x < model.width_px; ++x) {
      const Eigen::Vector2d pixel(x, y);
      rays(x, y) =
          undistorted_by(lens, (pixel - model.principal_point_px).cwiseQuotient(model.focal_px))
              .cast<float>();
    }
  });
  return rays;
}

}  // namespace

Eigen::Vector2d CameraModel::distort(const Eigen::Vector2d& normalized) const {
  return distorted_by(Distortion<double>(distortion), normalized);
}

Eigen::Matrix2d CameraModel::distort_jacobian(const Eigen::Vector2d& normalized) const {
  return jacobian_of(Distortion<double>(distortion), normalized);
}

Eigen::Vector2d CameraModel::undistort(const Eigen::Vector2d& distorted) const {
  return undistorted_by(Distortion<double>(distortion), distorted);
}

Eigen::Vector2d CameraModel::project(const Eigen::Vector3d& point) const {
  return focal_px.cwiseProduct(distort(point.head<2>() / point.z())) + principal_point_px;
}

Eigen::Vector2d CameraModel::ray(const Eigen::Vector2d& pixel) const {
  return undistort((pixel - principal_point_px).cwiseQuotient(focal_px));
}

Image<Eigen::Vector2f> rays_of(const CameraModel& model) {
  const Distortion<double> lens(model.distortion);
  return lens.extended ? extended_rays_of(model, lens) : basic_rays_of(model);
}

}  // namespace frangia
