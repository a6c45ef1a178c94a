#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "frangia/core/image.h"

namespace frangia {

/// Number of distortion coefficients, in OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x
/// tau_y.
inline constexpr std::size_t kDistortionCoefficients = 14;

/// The distortion of a lens as OpenCV models it, in precision T: radial (k1 k2 k3, and k4 k5 k6 in
/// a denominator), tangential (p1 p2), thin prism (s1 to s4), and a tilted sensor (tau_x tau_y,
/// rad).
///
/// The first five coefficients alone are the model of Brown and Conrady. Functions with
/// `kExtended` = false evaluate those only, so that loops over many points stay short.
///
/// @source   OpenCV, calib3d: distortPoints, computeTiltProjectionMatrix
template <typename T>
struct Distortion {
  /// A normalized point (x/z, y/z).
  struct Point {
    T x,    ///< along the rows of the image
        y;  ///< along the columns of the image
  };
  /// Derivatives of a distorted point (u, v) with respect to the point (x, y).
  struct Jacobian {
    T ux,    ///< du/dx
        uy,  ///< du/dy
        vx,  ///< dv/dx
        vy;  ///< dv/dy
  };

  /// Rounds the coefficients to precision T.
  explicit Distortion(const std::array<double, kDistortionCoefficients>& coefficients)
      : extended(std::any_of(coefficients.begin() + 5, coefficients.end(), [](double value) {
          return value != 0.0;
        })) {
    std::transform(coefficients.begin(), coefficients.end() - 2, c.begin(), [](double value) {
      return static_cast<T>(value);
    });
    if (extended) set_tilt(coefficients[12], coefficients[13]);
  }

  /// Applies the distortion to a point.
  template <bool kExtended>
  [[nodiscard]] Point distort(T x, T y) const {
    const T r2 = x * x + y * y;
    T radial = T{1} + r2 * (c[0] + r2 * (c[1] + r2 * c[4]));
    if constexpr (kExtended) radial /= T{1} + r2 * (c[5] + r2 * (c[6] + r2 * c[7]));
    T u = x * radial + T{2} * c[2] * x * y + c[3] * (r2 + T{2} * x * x);
    T v = y * radial + c[2] * (r2 + T{2} * y * y) + T{2} * c[3] * x * y;
    if constexpr (kExtended) {
      u += r2 * (c[8] + r2 * c[9]);
      v += r2 * (c[10] + r2 * c[11]);
      const T w = tilt[6] * u + tilt[7] * v + tilt[8];
      return {(tilt[0] * u + tilt[1] * v + tilt[2]) / w, (tilt[3] * u + tilt[4] * v + tilt[5]) / w};
    } else {
      return {u, v};
    }
  }

  /// Returns the derivatives of `distort`.
  template <bool kExtended>
  [[nodiscard]] Jacobian jacobian(T x, T y) const {
    const T two{2};
    const T three{3};
    const T r2 = x * x + y * y;
    T radial = T{1} + r2 * (c[0] + r2 * (c[1] + r2 * c[4]));
    T slope = two * (c[0] + r2 * (two * c[1] + r2 * three * c[4]));  // 2 d(radial) / d(r^2)
    if constexpr (kExtended) {
      const T below = T{1} + r2 * (c[5] + r2 * (c[6] + r2 * c[7]));
      const T slope_below = two * (c[5] + r2 * (two * c[6] + r2 * three * c[7]));
      radial /= below;
      slope = (slope - radial * slope_below) / below;
    }
    const T mixed = slope * x * y + T{2} * c[2] * x + T{2} * c[3] * y;
    Jacobian d{radial + slope * x * x + T{2} * c[2] * y + T{6} * c[3] * x,
               mixed,
               mixed,
               radial + slope * y * y + T{6} * c[2] * y + T{2} * c[3] * x};
    if constexpr (kExtended) {
      const T prism_u = T{2} * c[8] + T{4} * c[9] * r2;
      const T prism_v = T{2} * c[10] + T{4} * c[11] * r2;
      d = {d.ux + prism_u * x, d.uy + prism_u * y, d.vx + prism_v * x, d.vy + prism_v * y};
      d = tilted(d, x, y);
    }
    return d;
  }

  std::array<T, 12> c{};  ///< coefficients without the tilt
  /// Rows of the projection onto the tilted sensor.
  std::array<T, 9> tilt{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool extended;  ///< whether a coefficient beyond the fifth is not 0

 private:
  void set_tilt(double tau_x, double tau_y) {
    const double cx = std::cos(tau_x);
    const double sx = std::sin(tau_x);
    const double cy = std::cos(tau_y);
    const double sy = std::sin(tau_y);
    // R = R_y(tau_y) R_x(tau_x), then the projection along the optical axis onto the sensor.
    const double r02 = -sy * cx;
    const double r12 = sx;
    const double r22 = cy * cx;
    const std::array<double, 9> rotation{cy, sy * sx, r02, 0.0, cx, r12, sy, -cy * sx, r22};
    for (std::size_t i = 0; i < 3; ++i) {
      tilt[i] = static_cast<T>(r22 * rotation[i] - r02 * rotation[6 + i]);
      tilt[3 + i] = static_cast<T>(r22 * rotation[3 + i] - r12 * rotation[6 + i]);
      tilt[6 + i] = static_cast<T>(rotation[6 + i]);
    }
  }

  /// Chains the derivatives before the tilt with those of the tilt.
  [[nodiscard]] Jacobian tilted(const Jacobian& d, T x, T y) const {
    const T r2 = x * x + y * y;
    const T radial = (T{1} + r2 * (c[0] + r2 * (c[1] + r2 * c[4]))) /
                     (T{1} + r2 * (c[5] + r2 * (c[6] + r2 * c[7])));
    const T u =
        x * radial + T{2} * c[2] * x * y + c[3] * (r2 + T{2} * x * x) + r2 * (c[8] + r2 * c[9]);
    const T v =
        y * radial + c[2] * (r2 + T{2} * y * y) + T{2} * c[3] * x * y + r2 * (c[10] + r2 * c[11]);
    const T w = tilt[6] * u + tilt[7] * v + tilt[8];
    const T tu = (tilt[0] * u + tilt[1] * v + tilt[2]) / w;
    const T tv = (tilt[3] * u + tilt[4] * v + tilt[5]) / w;
    const T uu = (tilt[0] - tu * tilt[6]) / w;
    const T uv = (tilt[1] - tu * tilt[7]) / w;
    const T vu = (tilt[3] - tv * tilt[6]) / w;
    const T vv = (tilt[4] - tv * tilt[7]) / w;
    return {
        uu * d.ux + uv * d.vx, uu * d.uy + uv * d.vy, vu * d.ux + vv * d.vx, vu * d.uy + vv * d.vy};
  }
};

/// A pinhole camera with the distortion model of OpenCV. A digital projector is an inverse camera
/// and uses the same model. Pixel (0, 0) has its centre at (0, 0).
struct CameraModel {
  int width_px = 0;                                              ///< width of the image
  int height_px = 0;                                             ///< height of the image
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();            ///< focal lengths along x and y
  Eigen::Vector2d principal_point_px = Eigen::Vector2d::Zero();  ///< pixel on the optical axis
  /// k1 k2 p1 p2 k3, then k4 k5 k6 s1 s2 s3 s4 tau_x tau_y; see `Distortion`.
  std::array<double, kDistortionCoefficients> distortion{};

  /// Applies the distortion to the normalized point (x/z, y/z).
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& normalized) const;
  /// Returns the derivative of `distort` with respect to its argument.
  [[nodiscard]] Eigen::Matrix2d distort_jacobian(const Eigen::Vector2d& normalized) const;
  /// Inverts `distort` by Newton's method.
  ///
  /// @missing  NaN where the model folds back and has no inverse
  [[nodiscard]] Eigen::Vector2d undistort(const Eigen::Vector2d& distorted) const;

  /// Projects a point of the camera frame, with z > 0, to a pixel.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point) const;
  /// Returns the normalized point (x/z, y/z) on the ray of a pixel.
  ///
  /// @missing  NaN as `undistort`
  [[nodiscard]] Eigen::Vector2d ray(const Eigen::Vector2d& pixel) const;
};

/// Returns `model.ray` of every pixel, computed a row at a time.
///
/// @shape    height_px x width_px
/// @missing  NaN as `CameraModel::undistort`
[[nodiscard]] Image<Eigen::Vector2f> rays_of(const CameraModel& model);

/// Single-precision `CameraModel::project`. Loops over many points choose `kExtended` once, so that
/// the compiler vectorizes them.
struct FastCameraModel {
  /// Rounds the parameters of `model` to single precision.
  explicit FastCameraModel(const CameraModel& model)
      : fx(static_cast<float>(model.focal_px.x())),
        fy(static_cast<float>(model.focal_px.y())),
        cx(static_cast<float>(model.principal_point_px.x())),
        cy(static_cast<float>(model.principal_point_px.y())),
        lens(model.distortion) {}

  /// Projects a point with z > 0. The result for any other point is meaningless.
  ///
  /// `kExtended` is `lens.extended`, known at compile time.
  template <bool kExtended>
  void project(float px, float py, float pz, float& u, float& v) const {
    const float inverse = 1.0F / pz;
    const auto to = lens.distort<kExtended>(px * inverse, py * inverse);
    u = cx + fx * to.x;
    v = cy + fy * to.y;
  }
  /// Projects a single point.
  void project(float px, float py, float pz, float& u, float& v) const {
    lens.extended ? project<true>(px, py, pz, u, v) : project<false>(px, py, pz, u, v);
  }

  /// Returns the derivatives of the pixel (u, v) at the normalized point (x, y) = (X/Z, Y/Z).
  template <bool kExtended>
  [[nodiscard]] Distortion<float>::Jacobian jacobian(float x, float y) const {
    const auto d = lens.jacobian<kExtended>(x, y);
    return {fx * d.ux, fx * d.uy, fy * d.vx, fy * d.vy};
  }

  float fx,                ///< focal length along x, px
      fy,                  ///< focal length along y, px
      cx,                  ///< principal point, column
      cy;                  ///< principal point, row
  Distortion<float> lens;  ///< distortion of the normalized point
};

}  // namespace frangia
