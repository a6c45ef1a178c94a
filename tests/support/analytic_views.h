#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia::testing {

/// Signed distance to a shape, in mm of the object frame, positive outside; never too large.
using Shape = std::function<double(const Eigen::Vector3d&)>;

inline Shape sphere(double radius_mm, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  return [=](const Eigen::Vector3d& p) { return (p - centre).norm() - radius_mm; };
}

inline Shape box(const Eigen::Vector3d& half_mm,
                 const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  return [=](const Eigen::Vector3d& p) {
    const Eigen::Array3d out = (p - centre).array().abs() - half_mm.array();
    return out.max(0.0).matrix().norm() + std::min(out.maxCoeff(), 0.0);
  };
}

/// The half space below a height.
inline Shape floor_at(double z_mm) {
  return [=](const Eigen::Vector3d& p) { return p.z() - z_mm; };
}

inline Shape both(const Shape& one, const Shape& other) {
  return [=](const Eigen::Vector3d& p) { return std::min(one(p), other(p)); };
}

/// A ball with lumps on all sides, no two alike.
inline double lumpy(const Eigen::Vector3d& p) {
  static const std::vector<std::pair<Eigen::Vector3d, double>> kBalls = {
      {{0.0, 0.0, 0.0}, 28.0},
      {{24.0, 6.0, 8.0}, 12.0},
      {{4.0, 26.0, -6.0}, 9.0},
      {{-20.0, 16.0, 12.0}, 10.0},
      {{-22.0, -14.0, -4.0}, 13.0},
      {{2.0, -24.0, 14.0}, 11.0},
      {{16.0, -20.0, -10.0}, 8.0},
      {{0.0, 4.0, 26.0}, 10.0}};
  double nearest = 1e9;
  for (const auto& [centre, radius] : kBalls)
    nearest = std::min(nearest, (p - centre).norm() - radius);
  return nearest;
}

inline CameraModel small_camera_model(int size_px = 300, double focal_px = 1500.0) {
  CameraModel model;
  model.width_px = size_px;
  model.height_px = size_px;
  model.focal_px = {focal_px, focal_px};
  model.principal_point_px = {0.5 * size_px + 1.3, 0.5 * size_px - 2.1};
  model.distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.0};
  return model;
}

/// A camera at `distance_mm` that looks at the object's origin, from a longitude and a latitude.
inline Eigen::Isometry3d look_from(double longitude_rad, double latitude_rad, double distance_mm) {
  const Eigen::Vector3d from(std::cos(latitude_rad) * std::cos(longitude_rad),
                             std::cos(latitude_rad) * std::sin(longitude_rad),
                             std::sin(latitude_rad));
  const Eigen::Vector3d right = (Eigen::Vector3d::UnitZ().cross(from)).normalized();
  Eigen::Matrix3d rows;  // the camera's x right, y down, z forward, in the object frame
  rows << right.transpose(), -from.cross(right).transpose(), -from.transpose();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rows;
  pose.translation() = Eigen::Vector3d(0.0, 0.0, distance_mm);
  return pose;
}

/// Poses spread evenly over all directions.
inline std::vector<Eigen::Isometry3d> all_around(int count, double distance_mm) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    poses.push_back(look_from(2.399963 * i, std::asin(z), distance_mm));
  }
  return poses;
}

/// Poses of a turntable: every view from the same latitude.
inline std::vector<Eigen::Isometry3d> around_table(int count,
                                                   double latitude_rad,
                                                   double distance_mm) {
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    poses.push_back(look_from(kTwoPi * i / count, latitude_rad, distance_mm));
  }
  return poses;
}

struct Snapshot {
  double noise_mm = 0.02;      ///< of each pixel, along its ray
  double sigma_mm = 0.02;      ///< what the grid claims
  double far_mm = 2000.0;      ///< nothing is seen beyond
  double steepest_rad = 1.45;  ///< nothing is seen at flatter incidence
  std::uint32_t seed = 1;
};

/// How far along a unit ray the shape is, NaN where it is missed: sphere tracing.
inline double trace(const Shape& shape,
                    const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& ray,
                    double far_mm) {
  double t = 0.0;
  for (int step = 0; step < 1000 && t < far_mm; ++step) {
    const double distance = shape(origin + t * ray);
    if (distance < 1e-7) return t;
    t += distance;
  }
  return std::nan("");
}

/// What the camera sees of the shape, with noise of its own at each pixel. The same seed gives the
/// same.
inline View snapshot(const Shape& shape,
                     const CameraModel& model,
                     const Eigen::Isometry3d& rig_from_object,
                     const Snapshot& how = {}) {
  View view{{Image<float>(model.width_px, model.height_px, kMissing),
             Image<float>(model.width_px, model.height_px, kMissing)},
            rig_from_object};
  const Eigen::Isometry3d object_from_rig = rig_from_object.inverse();
  const Eigen::Vector3d eye = object_from_rig.translation();
  const auto rays = rays_of(model);
  parallel_rows(model.height_px, [&](int y) {
    std::mt19937 generator(how.seed * 7919U + static_cast<std::uint32_t>(y));
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int x = 0; x < model.width_px; ++x) {
      const Eigen::Vector3d ray = rays(x, y).cast<double>().homogeneous().normalized();
      const Eigen::Vector3d along = object_from_rig.linear() * ray;
      const double t = trace(shape, eye, along, how.far_mm);
      const double error_mm = how.noise_mm * noise(generator);
      if (std::isnan(t)) continue;
      constexpr double kStep = 1e-3;
      const Eigen::Vector3d hit = eye + t * along;
      Eigen::Vector3d normal;
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
        normal[i] = shape(hit + step) - shape(hit - step);
      }
      if (-normal.normalized().dot(along) < std::cos(how.steepest_rad)) continue;
      view.range.depth_mm(x, y) = static_cast<float>((t + error_mm) * ray.z());
      view.range.sigma_mm(x, y) = static_cast<float>(how.sigma_mm);
    }
  });
  return view;
}

/// A snapshot from each pose, each with a noise of its own.
inline ViewStore snapshots(const Shape& shape,
                           const CameraModel& model,
                           const std::vector<Eigen::Isometry3d>& poses,
                           Snapshot how = {}) {
  ViewStore store;
  for (const auto& pose : poses) {
    store.add(snapshot(shape, model, pose, how));
    ++how.seed;
  }
  return store;
}

}  // namespace frangia::testing
