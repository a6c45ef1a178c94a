#include "frangia/rig/lens.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "frangia/core/parallel.h"

namespace frangia {

Eigen::Vector2d Lens::distort(const Eigen::Vector2d& normalised) const {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = normalised.x();
  const double y = normalised.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Eigen::Matrix2d Lens::distort_jacobian(const Eigen::Vector2d& normalised) const {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = normalised.x();
  const double y = normalised.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // d radial / d r2, times 2
  Eigen::Matrix2d jacobian;
  jacobian << radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
      slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y,  //
      slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y,
      radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  return jacobian;
}

Eigen::Vector2d Lens::undistort(const Eigen::Vector2d& distorted) const {
  Eigen::Vector2d guess = distorted;
  constexpr int kIterations = 20;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector2d error = distort(guess) - distorted;
    if (error.squaredNorm() < 1e-28) return guess;
    const Eigen::Matrix2d jacobian = distort_jacobian(guess);
    if (!(jacobian.determinant() > 1e-3)) break;
    guess -= jacobian.inverse() * error;
  }
  if ((distort(guess) - distorted).squaredNorm() < 1e-20) return guess;
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

Eigen::Vector2d Lens::project(const Eigen::Vector3d& point) const {
  return focal_px.cwiseProduct(distort(point.head<2>() / point.z())) + principal_point_px;
}

Eigen::Vector2d Lens::ray(const Eigen::Vector2d& pixel) const {
  return undistort((pixel - principal_point_px).cwiseQuotient(focal_px));
}

Image<Eigen::Vector2f> rays_of(const Lens& lens) {
  Image<Eigen::Vector2f> rays(lens.width_px, lens.height_px, Eigen::Vector2f::Zero());
  parallel_rows(lens.height_px, [&](int y) {
    for (int x = 0; x < lens.width_px; ++x) {
      rays(x, y) = lens.ray(Eigen::Vector2d(x, y)).cast<float>();
    }
  });
  return rays;
}

}  // namespace frangia
