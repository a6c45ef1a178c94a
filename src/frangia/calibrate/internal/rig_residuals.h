#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>
#include <ceres/rotation.h>

#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/core/angles.h"

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

/// The center of the ellipse that is nearest to the image of a circle about `center`, which
/// perspective and distortion move away from the image of its center. It follows from six points of
/// the circle: an ellipse is the image of the unit circle under an affine map, and a deviation from
/// it moves its center by the first harmonic of the radial component.
template <typename T>
[[nodiscard]] Eigen::Matrix<T, 2, 1> project_circle(const T* intrinsics,
                                                    const T* pose,
                                                    const T* from_reference,
                                                    double radius_mm,
                                                    const Eigen::Matrix<T, 3, 1>& center) {
  Eigen::Matrix<T, 3, 2> axes;  // of the circle, in the frame of the camera
  for (const int axis : {0, 1}) {
    Eigen::Matrix<T, 3, 1> along = T(radius_mm) * Eigen::Matrix<T, 3, 1>::Unit(axis);
    Eigen::Matrix<T, 3, 1> rotated;
    ceres::AngleAxisRotatePoint(pose, along.data(), rotated.data());
    if (from_reference != nullptr) {
      along = rotated;
      ceres::AngleAxisRotatePoint(from_reference, along.data(), rotated.data());
    }
    axes.col(axis) = rotated;
  }
  constexpr int kPoints = 6;
  Eigen::Matrix<double, 2, kPoints> circle;
  Eigen::Matrix<T, 2, kPoints> pixels;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = kTwoPi * i / kPoints;
    circle.col(i) << std::cos(angle), std::sin(angle);
    const Eigen::Matrix<T, 2, 1> place = circle.col(i).cast<T>();
    pixels.col(i) = project_point(intrinsics, Eigen::Matrix<T, 3, 1>(center + axes * place));
  }
  const T share(2.0 / kPoints);
  const Eigen::Matrix<T, 2, 1> mean = pixels.rowwise().mean();
  const Eigen::Matrix<T, 2, 2> affine = share * pixels * circle.transpose().cast<T>();
  const Eigen::Matrix<T, 2, kPoints> unit = affine.inverse() * (pixels.colwise() - mean);
  Eigen::Matrix<T, 2, 1> shift = Eigen::Matrix<T, 2, 1>::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Matrix<T, 2, 1> place = circle.col(i).cast<T>();
    shift += share * place.dot(unit.col(i)) * place;
  }
  return mean + affine * shift;
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
    const Eigen::Matrix<T, 2, 1> predicted =
        circle_radius_mm > 0.0
            ? project_circle(intrinsics, pose, from_reference, circle_radius_mm, point)
            : project_point(intrinsics, point);
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
