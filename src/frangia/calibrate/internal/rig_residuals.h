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

/// A point of the reference camera's frame in that of a camera; null is the reference camera.
template <typename T>
[[nodiscard]] Eigen::Matrix<T, 3, 1> in_camera(const T* from_reference,
                                               const Eigen::Matrix<T, 3, 1>& point) {
  return from_reference == nullptr ? point : transform(from_reference, point);
}

/// A point on the ray through the center of the ellipse that a circle about `center` shows. It is
/// the last column of the dual conic of the image, H diag(r^2, r^2, -1) H^T.
template <typename T>
[[nodiscard]] Eigen::Matrix<T, 3, 1> ellipse_center(const T* pose,
                                                    const T* from_reference,
                                                    double radius_mm,
                                                    const Eigen::Matrix<T, 3, 1>& center) {
  Eigen::Matrix<T, 3, 1> conic = center.z() * center;
  for (const int axis : {0, 1}) {
    Eigen::Matrix<T, 3, 1> along = Eigen::Matrix<T, 3, 1>::Unit(axis);
    Eigen::Matrix<T, 3, 1> rotated;
    ceres::AngleAxisRotatePoint(pose, along.data(), rotated.data());
    if (from_reference != nullptr) {
      along = rotated;
      ceres::AngleAxisRotatePoint(from_reference, along.data(), rotated.data());
    }
    conic -= radius_mm * radius_mm * rotated.z() * rotated;
  }
  return conic;
}

/// Weighted residual of a point seen by a camera.
struct CameraResidual {
  BoardSite site;
  double circle_radius_mm;  ///< 0 for a corner
  Eigen::Vector2d pixel;
  Eigen::Vector2d weight;

  /// By the reference camera.
  template <typename T>
  bool operator()(const T* intrinsics, const T* shape, const T* pose, T* residual) const {
    return evaluate<T>(intrinsics, nullptr, shape, pose, residual);
  }
  /// By a further camera.
  template <typename T>
  bool operator()(const T* intrinsics,
                  const T* from_reference,
                  const T* shape,
                  const T* pose,
                  T* residual) const {
    return evaluate<T>(intrinsics, from_reference, shape, pose, residual);
  }

  template <typename T>
  bool evaluate(const T* intrinsics,
                const T* from_reference,
                const T* shape,
                const T* pose,
                T* residual) const {
    const Eigen::Matrix<T, 3, 1> point =
        in_camera(from_reference, transform(pose, site.position(shape)));
    if (!(point.z() > T(0.0))) return false;
    const Eigen::Matrix<T, 2, 1> predicted = project_point(
        intrinsics,
        circle_radius_mm > 0.0 ? ellipse_center(pose, from_reference, circle_radius_mm, point)
                               : point);
    residual[0] = weight.x() * (predicted.x() - pixel.x());
    residual[1] = weight.y() * (predicted.y() - pixel.y());
    return true;
  }
};

/// The projector pixel that a camera reads at one of its pixels.
struct PhaseReading {
  Eigen::Vector2d camera_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d projector_by_camera = Eigen::Matrix2d::Zero();  ///< see BoardPoint

  /// By how much the projector pixel is off because the camera sees the point at another pixel.
  /// The center of a circle, not that of its ellipse: the phase is carried over to this point.
  template <typename T>
  [[nodiscard]] Eigen::Matrix<T, 2, 1> carried(const T* intrinsics,
                                               const Eigen::Matrix<T, 3, 1>& point) const {
    const Eigen::Matrix<T, 2, 1> shift = project_point(intrinsics, point) - camera_px.cast<T>();
    return {projector_by_camera(0, 0) * shift.x() + projector_by_camera(0, 1) * shift.y(),
            projector_by_camera(1, 0) * shift.x() + projector_by_camera(1, 1) * shift.y()};
  }
};

/// Weighted residual of the projector pixel that lights a point, without the part that the error of
/// the camera's pixel causes.
struct ProjectorResidual {
  BoardSite site;
  Eigen::Vector2d pixel;
  Eigen::Vector2d weight;
  PhaseReading reading;

  /// Read by the reference camera.
  template <typename T>
  // NOLINTNEXTLINE(readability-function-size) Ceres passes each block by itself
  bool operator()(const T* camera,
                  const T* intrinsics,
                  const T* projector_from_camera,
                  const T* shape,
                  const T* pose,
                  T* residual) const {
    return evaluate<T>(camera, nullptr, intrinsics, projector_from_camera, shape, pose, residual);
  }
  /// Read by a further camera.
  template <typename T>
  // NOLINTNEXTLINE(readability-function-size) Ceres passes each block by itself
  bool operator()(const T* camera,
                  const T* from_reference,
                  const T* intrinsics,
                  const T* projector_from_camera,
                  const T* shape,
                  const T* pose,
                  T* residual) const {
    return evaluate<T>(
        camera, from_reference, intrinsics, projector_from_camera, shape, pose, residual);
  }

  template <typename T>
  // NOLINTNEXTLINE(readability-function-size) Ceres passes each block by itself
  bool evaluate(const T* camera,
                const T* from_reference,
                const T* intrinsics,
                const T* projector_from_camera,
                const T* shape,
                const T* pose,
                T* residual) const {
    const Eigen::Matrix<T, 3, 1> place = transform(pose, site.position(shape));
    const Eigen::Matrix<T, 3, 1> seen = in_camera(from_reference, place);
    const Eigen::Matrix<T, 3, 1> lit = transform(projector_from_camera, place);
    if (!(seen.z() > T(0.0)) || !(lit.z() > T(0.0))) return false;
    const Eigen::Matrix<T, 2, 1> carried = reading.carried(camera, seen);
    const Eigen::Matrix<T, 2, 1> predicted = project_point(intrinsics, lit);
    for (int i = 0; i < 2; ++i)
      residual[i] = weight[i] * (predicted[i] - pixel[i] - carried[i]);
    return true;
  }
};

/// Weighted difference of the projector pixels that two cameras read at one point, each carried to
/// the pixel where the camera sees it. It needs no model of the projector.
struct LabelResidual {
  BoardSite site;
  Eigen::Vector2d difference;  ///< that of the further camera minus that of the reference camera
  Eigen::Vector2d weight;
  PhaseReading reference;
  PhaseReading further;

  template <typename T>
  // NOLINTNEXTLINE(readability-function-size) Ceres passes each block by itself
  bool operator()(const T* reference_intrinsics,
                  const T* intrinsics,
                  const T* from_reference,
                  const T* shape,
                  const T* pose,
                  T* residual) const {
    const Eigen::Matrix<T, 3, 1> place = transform(pose, site.position(shape));
    const Eigen::Matrix<T, 3, 1> seen = transform(from_reference, place);
    if (!(place.z() > T(0.0)) || !(seen.z() > T(0.0))) return false;
    const Eigen::Matrix<T, 2, 1> a = reference.carried(reference_intrinsics, place);
    const Eigen::Matrix<T, 2, 1> b = further.carried(intrinsics, seen);
    for (int i = 0; i < 2; ++i)
      residual[i] = weight[i] * (a[i] - b[i] - difference[i]);
    return true;
  }
};

}  // namespace frangia
