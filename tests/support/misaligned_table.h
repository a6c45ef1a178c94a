#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "frangia/registration/register_views.h"

#include "support/analytic_views.h"

namespace frangia::testing {

/// The true turntable of a camera that looks down on a part 650 mm away, and the given one.
struct MisalignedTable {
  Turntable truth{{2.0, 8.0, 650.0}, Eigen::Vector3d(0.03, -0.9, -0.4).normalized()};
  Turntable given = truth;
  std::vector<double> true_angles_rad;
  std::vector<double> angles_rad;

  explicit MisalignedTable(int views, double angle_noise_rad = rad_from_deg(0.15)) {
    std::mt19937 generator(5);
    std::normal_distribution<double> noise(0.0, angle_noise_rad);
    for (int i = 0; i < views; ++i) {
      true_angles_rad.push_back(kTwoPi * i / views);
      angles_rad.push_back(true_angles_rad.back() + (i == 0 ? 0.0 : noise(generator)));
    }
    given.axis = Eigen::AngleAxisd(rad_from_deg(0.3), Eigen::Vector3d::UnitX()) * truth.axis;
    given.point_mm += Eigen::Vector3d(0.4, 0.2, 0.2);
  }
  [[nodiscard]] std::vector<Station> stations() const {
    std::vector<Station> all;
    for (const double angle : angles_rad)
      all.push_back({angle, ""});
    return all;
  }
  [[nodiscard]] ViewStore take(const Shape& shape,
                               const CameraModel& model = small_camera_model()) const {
    std::vector<Eigen::Isometry3d> poses;
    for (const double angle : true_angles_rad)
      poses.push_back(truth.rig_from_object(angle));
    return snapshots(shape, model, poses);
  }
};

/// A body with bumps and without symmetry.
inline double knobbly(const Eigen::Vector3d& p) {
  const double bumps =
      std::sin(0.22 * p.x()) * std::sin(0.19 * p.y() + 0.4) * std::sin(0.25 * p.z() + 0.2);
  return 0.6 * (Eigen::Vector3d(p.x() / 1.2, p.y(), p.z()).norm() - 38.0 - 2.0 * bumps);
}

inline double axis_error_rad(const Turntable& one, const Turntable& other) {
  return std::asin(one.axis.cross(other.axis).norm());
}
inline double shift_mm(const Turntable& one, const Turntable& other) {
  const Eigen::Vector3d away = one.point_mm - other.point_mm;
  return (away - other.axis * other.axis.dot(away)).norm();
}

}  // namespace frangia::testing
