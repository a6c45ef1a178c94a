#pragma once

#include "frangia/rig/camera_model.h"

namespace frangia {

/// Single-precision `CameraModel::project`, written so that the compiler vectorizes it.
struct FastCameraModel {
  /// Rounds the parameters of `model` to single precision.
  explicit FastCameraModel(const CameraModel& model)
      : fx(static_cast<float>(model.focal_px.x())),
        fy(static_cast<float>(model.focal_px.y())),
        cx(static_cast<float>(model.principal_point_px.x())),
        cy(static_cast<float>(model.principal_point_px.y())),
        k1(static_cast<float>(model.distortion[0])),
        k2(static_cast<float>(model.distortion[1])),
        p1(static_cast<float>(model.distortion[2])),
        p2(static_cast<float>(model.distortion[3])),
        k3(static_cast<float>(model.distortion[4])) {}

  /// Projects a point with z > 0. The result for any other point is meaningless.
  void project(float px, float py, float pz, float& u, float& v) const {
    const float inverse = 1.0F / pz;
    const float x = px * inverse;
    const float y = py * inverse;
    const float r2 = x * x + y * y;
    const float radial = 1.0F + r2 * (k1 + r2 * (k2 + r2 * k3));
    u = cx + fx * (x * radial + 2.0F * p1 * x * y + p2 * (r2 + 2.0F * x * x));
    v = cy + fy * (y * radial + p1 * (r2 + 2.0F * y * y) + 2.0F * p2 * x * y);
  }

  /// Derivatives of the pixel (u, v) with respect to the normalized point (x, y) = (X/Z, Y/Z).
  struct Jacobian {
    float ux,  ///< du/dx
        uy,    ///< du/dy
        vx,    ///< dv/dx
        vy;    ///< dv/dy
  };
  /// Returns the derivatives at the normalized point (x, y).
  [[nodiscard]] Jacobian jacobian(float x, float y) const {
    const float r2 = x * x + y * y;
    const float radial = 1.0F + r2 * (k1 + r2 * (k2 + r2 * k3));
    const float slope = 2.0F * (k1 + r2 * (2.0F * k2 + r2 * 3.0F * k3));
    const float mixed = slope * x * y + 2.0F * p1 * x + 2.0F * p2 * y;
    return {fx * (radial + slope * x * x + 2.0F * p1 * y + 6.0F * p2 * x),
            fx * mixed,
            fy * mixed,
            fy * (radial + slope * y * y + 6.0F * p1 * y + 2.0F * p2 * x)};
  }

  float fx,  ///< focal length along x, px
      fy,    ///< focal length along y, px
      cx,    ///< principal point, column
      cy,    ///< principal point, row
      k1,    ///< radial distortion, factor of r^2
      k2,    ///< radial distortion, factor of r^4
      p1,    ///< tangential distortion, first coefficient
      p2,    ///< tangential distortion, second coefficient
      k3;    ///< radial distortion, factor of r^6
};

}  // namespace frangia
