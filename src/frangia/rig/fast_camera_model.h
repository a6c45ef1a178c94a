#pragma once

#include "frangia/rig/camera_model.h"
#include "frangia/rig/distortion.h"

namespace frangia {

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
