#pragma once

#include <Eigen/Core>
#include <ceres/rotation.h>

#include "frangia/calibrate/internal/rig_model.h"

namespace frangia {

/// A point moved by a pose, a rotation vector and a translation.
template <typename T>
[[nodiscard]] Eigen::Matrix<T, 3, 1> transform(const T* pose, const Eigen::Matrix<T, 3, 1>& point) {
  Eigen::Matrix<T, 3, 1> rotated;
  ceres::AngleAxisRotatePoint(pose, point.data(), rotated.data());
  return {rotated.x() + pose[3], rotated.y() + pose[4], rotated.z() + pose[5]};
}

/// Weighted residual of a point seen by the camera.
struct CameraResidual {
  BoardSite site;
  double circle_radius_mm;  ///< 0 for a corner
  Eigen::Vector2d pixel;
  Eigen::Vector2d weight;

  template <typename T>
  bool operator()(const T* intrinsics, const T* shape, const T* pose, T* residual) const {
    const Eigen::Matrix<T, 3, 1> point = transform(pose, site.position(shape));
    if (!(point.z() > T(0.0))) return false;
    const Eigen::Matrix<T, 2, 1> predicted =
        project_point(intrinsics, circle_radius_mm > 0.0 ? ellipse_center(pose, point) : point);
    residual[0] = weight.x() * (predicted.x() - pixel.x());
    residual[1] = weight.y() * (predicted.y() - pixel.y());
    return true;
  }

  /// A point on the ray through the center of the ellipse that a circle about `center` shows. It is
  /// the last column of the dual conic of the image, H diag(r^2, r^2, -1) H^T.
  template <typename T>
  [[nodiscard]] Eigen::Matrix<T, 3, 1> ellipse_center(const T* pose,
                                                      const Eigen::Matrix<T, 3, 1>& center) const {
    Eigen::Matrix<T, 3, 1> conic = center.z() * center;
    for (const int axis : {0, 1}) {
      const Eigen::Matrix<T, 3, 1> along = Eigen::Matrix<T, 3, 1>::Unit(axis);
      Eigen::Matrix<T, 3, 1> rotated;
      ceres::AngleAxisRotatePoint(pose, along.data(), rotated.data());
      conic -= circle_radius_mm * circle_radius_mm * rotated.z() * rotated;
    }
    return conic;
  }
};

/// Weighted residual of the projector pixel that lights a point, without the part that the error of
/// the camera's pixel causes.
struct ProjectorResidual {
  BoardSite site;
  Eigen::Vector2d pixel;
  Eigen::Vector2d weight;
  Eigen::Vector2d camera_px;
  Eigen::Matrix2d projector_by_camera;

  template <typename T>
  bool operator()(const T* camera,
                  const T* intrinsics,
                  const T* projector_from_camera,
                  const T* shape,
                  const T* pose,
                  T* residual) const {
    const Eigen::Matrix<T, 3, 1> seen = transform(pose, site.position(shape));
    const Eigen::Matrix<T, 3, 1> lit = transform(projector_from_camera, seen);
    if (!(seen.z() > T(0.0)) || !(lit.z() > T(0.0))) return false;
    // The center of a circle, not that of its ellipse: the phase is carried over to this point.
    const Eigen::Matrix<T, 2, 1> shift = project_point(camera, seen) - camera_px.cast<T>();
    const Eigen::Matrix<T, 2, 1> predicted = project_point(intrinsics, lit);
    for (int i = 0; i < 2; ++i)
      residual[i] = weight[i] * (predicted[i] - pixel[i] - projector_by_camera(i, 0) * shift.x() -
                                 projector_by_camera(i, 1) * shift.y());
    return true;
  }
};

}  // namespace frangia
