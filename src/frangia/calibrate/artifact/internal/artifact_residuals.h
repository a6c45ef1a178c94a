#pragma once

#include <cmath>

#include <Eigen/Core>
#include <ceres/rotation.h>

#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/rig_residuals.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// A unit vector near `middle`, tilted across it by two small numbers.
template <typename T>
[[nodiscard]] Eigen::Matrix<T, 3, 1> tilted(const Eigen::Vector3d& middle, const T& a, const T& b) {
  const Eigen::Vector3d u = middle.unitOrthogonal();
  const Eigen::Vector3d v = middle.cross(u);
  return (middle.cast<T>() + a * u.cast<T>() + b * v.cast<T>()).normalized();
}

/// The ray of a camera pixel as the intrinsics change: linear about those of the start.
struct LinearRay {
  Eigen::Vector2d ray;
  Eigen::Matrix<double, 2, 9> by_intrinsics;
  Eigen::Matrix<double, 9, 1> intrinsics;  ///< of the start

  template <typename T>
  [[nodiscard]] Eigen::Matrix<T, 3, 1> at(const T* camera) const {
    Eigen::Matrix<T, 3, 1> out(T(ray.x()), T(ray.y()), T(1.0));
    for (int i = 0; i < 9; ++i) {
      const T change = camera[i] - intrinsics[i];
      out.x() += by_intrinsics(0, i) * change;
      out.y() += by_intrinsics(1, i) * change;
    }
    return out;
  }
};

/// The turning table.
struct TableStart {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d axis;
};

/// Where a ray meets a plate or ball that has turned with the table.
struct TurnedSurface {
  LinearRay ray;
  TableStart table;
  double angle_rad;
  Eigen::Vector4d start;  ///< see `ArtifactCapture::surfaces`
  bool is_ball;
  double radius_mm;

  template <typename T>
  bool intersect(const T* camera,
                 const T* moved_table,
                 const T* angle_error,
                 const T* surface,
                 Eigen::Matrix<T, 3, 1>& point) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Vector axis = tilted(table.axis, moved_table[0], moved_table[1]);
    const Eigen::Vector3d u = table.axis.unitOrthogonal();
    const Eigen::Vector3d v = table.axis.cross(u);
    const Vector pivot =
        table.point_mm.cast<T>() + moved_table[2] * u.cast<T>() + moved_table[3] * v.cast<T>();
    const Vector turn = axis * (angle_error[0] + angle_rad);
    const auto turned = [&](const Vector& vector) {
      Vector out;
      ceres::AngleAxisRotatePoint(turn.data(), vector.data(), out.data());
      return out;
    };
    const Vector direction = ray.at(camera);
    if (!is_ball) {
      const Vector normal = tilted(Eigen::Vector3d(start.head<3>()), surface[0], surface[1]);
      const Vector now = turned(normal);
      const T offset = surface[2] + now.dot(pivot) - normal.dot(pivot);
      point = direction * (offset / now.dot(direction));
      return point.z() > T(0.0);
    }
    const Vector center(surface[0], surface[1], surface[2]);
    const Vector now = pivot + turned(center - pivot);
    const T radius = radius_mm * (T(1.0) + surface[3]);
    const T square = direction.squaredNorm();
    const T middle = direction.dot(now);
    const T inside = middle * middle - square * (now.squaredNorm() - radius * radius);
    // A ray that just misses meets the ball where it is nearest, so that the residual stays finite.
    const T least = 1e-4 * square * radius * radius;
    const T root = sqrt(inside > least ? inside : least);
    point = direction * ((middle - root) / square);
    return point.z() > T(0.0);
  }
};

/// Weighted difference of the predicted light and that seen at a site.
struct LightResidual {
  TurnedSurface surface;
  const AngularModel* angular;  ///< null for a digital projector
  Eigen::Vector2d light;
  Eigen::Vector2d weight;  ///< 0 for a direction that is not measured

  template <typename T>
  // NOLINTNEXTLINE(readability-function-size) Ceres passes each block by itself
  bool operator()(const T* camera,
                  const T* intrinsics,
                  const T* pose,
                  const T* pitch,
                  const T* wavefront,
                  const T* table,
                  const T* angle_error,
                  const T* shape,
                  T* residual) const {
    Eigen::Matrix<T, 3, 1> point;
    if (!surface.intersect(camera, table, angle_error, shape, point)) return false;
    const Eigen::Matrix<T, 3, 1> lit = transform(pose, point);
    if (!(lit.z() > T(0.0))) return false;
    Eigen::Matrix<T, 2, 1> predicted;
    if (angular != nullptr) {
      const auto [u, v] = angular->in_field(lit.x(), lit.y(), lit.z());
      predicted.x() = (atan2(lit.x(), lit.z()) + Wavefront::deviation(wavefront, u, v)) / pitch[0];
      predicted.y() = T(0.0);
    } else {
      predicted = project_point(intrinsics, lit);
    }
    for (int i = 0; i < 2; ++i)
      residual[i] = weight[i] > 0.0 ? T(weight[i] * (predicted[i] - light[i])) : T(0.0);
    return true;
  }
};

/// Distance of the centers of two balls.
struct SpacingResidual {
  double spacing_mm;
  double weight;

  template <typename T>
  bool operator()(const T* first, const T* second, T* residual) const {
    const Eigen::Matrix<T, 3, 1> between(
        second[0] - first[0], second[1] - first[1], second[2] - first[2]);
    residual[0] = weight * (between.norm() - spacing_mm);
    return true;
  }
};

/// Length of a pose's translation.
struct LengthResidual {
  double length_mm;
  double weight;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    const Eigen::Matrix<T, 3, 1> shift(pose[3], pose[4], pose[5]);
    residual[0] = weight * (shift.norm() - length_mm);
    return true;
  }
};

/// A normal prior of one number of a block.
struct NumberPrior {
  int index;
  double mean;
  double weight;

  template <typename T>
  bool operator()(const T* block, T* residual) const {
    residual[0] = weight * (block[index] - mean);
    return true;
  }
};

}  // namespace frangia
