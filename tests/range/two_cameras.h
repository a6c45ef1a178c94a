#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/range/fuse_cameras.h"
#include "frangia/range/match_by_phase.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

namespace frangia::testing {

inline constexpr double kNone = static_cast<double>(kMissing);
inline constexpr double kSigma_rad = 0.02;
/// A period of 30 pixels of the cameras, so that they resolve harmonics.
inline constexpr double kCoarse_px = 160.0;

/// Turns z towards a target; x stays as horizontal as it can.
inline Eigen::Matrix3d looking_at(const Eigen::Vector3d& from, const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - from).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitY().cross(z).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  return rotation;
}

struct TwoCameraOptions {
  Eigen::Vector3d second_mm = {150.0, 0.0, 20.0};
  double scale = 1.0;
  bool label = false;
  int directions = 1;
  double harmonic_rad = 0.0;  ///< amplitude of an error of four periods in a fringe
  double period_px = 40.0;
  double turned_rad = 0.0;  ///< of the second camera against the rig
  bool bead = false;        ///< a bead hangs in front of the ball
};

/// A ball in front of two cameras and a projector, with phases computed from its surface.
struct TwoCameras {
  explicit TwoCameras(const TwoCameraOptions& given)
      : options(given),
        center_mm(given.scale * Eigen::Vector3d(0.0, 0.0, 500.0)),
        radius_mm(40.0 * given.scale) {
    if (options.bead) bead_radius_mm = 4.0 * given.scale;
    const double s = options.scale;
    rig.reference().model = {.width_px = 160,
                             .height_px = 128,
                             .focal_px = {700.0, 700.0},
                             .principal_point_px = {79.5, 63.5},
                             .distortion = {-0.05}};
    rig.projector.model = PinholeModel{.width_px = 1000,
                                       .height_px = 800,
                                       .focal_px = {4000.0, 4000.0},
                                       .principal_point_px = {499.5, 399.5}};
    rig.projector.position_mm = s * Eigen::Vector3d(-120.0, -15.0, 10.0);
    rig.projector.rotation = looking_at(rig.projector.position_mm, center_mm);
    PosedCamera second;
    second.camera.name = "second";
    second.camera.model = rig.reference().model;
    second.camera.model.focal_px *= 1.1;
    second.position_mm = s * options.second_mm;
    second.rotation = looking_at(second.position_mm, center_mm);
    rig.cameras.push_back(second);
    for (const FringeDirection direction :
         {FringeDirection::Vertical, FringeDirection::Horizontal}) {
      Pattern pattern;
      pattern.direction = direction;
      pattern.period_px = options.period_px;
      pattern.shifts_rad = {0.0, kPi / 2, kPi, 3 * kPi / 2};
      patterns.push_back(pattern);
    }
    patterns.resize(static_cast<std::size_t>(options.directions));
    const Rig truth = rig;
    rig.cameras[1].rotation =
        Eigen::AngleAxisd(options.turned_rad, Eigen::Vector3d::UnitX()).toRotationMatrix() *
        rig.cameras[1].rotation;
    rig.projector.is_label = options.label;
    for (std::size_t i = 0; i < 2; ++i) {
      rigs.push_back(rig_of_camera(rig, i));
      rays.push_back(rays_of(rigs.back().reference().model));
      for (const Pattern& pattern : patterns)
        phases[i].push_back(phase_of(rig_of_camera(truth, i), pattern, i));
    }
    for (std::size_t i = 0; i < 2; ++i) {
      cameras.push_back({rigs[i], rays[i], rig.cameras[i].camera_from_rig(), {}});
      for (const AbsolutePhase& phase : phases[i])
        cameras.back().phases.push_back(&phase);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (options.label) {
        const Image<float> start = match_by_phase(cameras[i], cameras[1 - i]);
        const Image<float> nothing(start.width(), start.height(), kMissing);
        ranges.push_back({start, nothing, nothing});
      } else {
        ranges.push_back(triangulate(phases[i].front(), rigs[i], rays[i]));
      }
    }
    alone = ranges;
  }

  /// How far along a direction a sphere begins; NaN where it is missed or behind.
  [[nodiscard]] static double distance_to(const Eigen::Vector3d& center,
                                          double radius,
                                          const Eigen::Vector3d& direction) {
    const double b = direction.dot(center) / direction.squaredNorm();
    const double rest = b * b - (center.squaredNorm() - radius * radius) / direction.squaredNorm();
    return rest > 0.0 && b > 0.0 ? b - std::sqrt(rest) : kNone;
  }

  /// The depth of the ball, or of the bead, on the ray of a camera; NaN where the ray meets
  /// neither.
  [[nodiscard]] double depth_of(const Eigen::Vector2d& ray, const Eigen::Isometry3d& camera) const {
    const double ball = distance_to(camera * center_mm, radius_mm, ray.homogeneous());
    const double bead = distance_to(camera * bead_mm, bead_radius_mm, ray.homogeneous());
    return std::isnan(bead) ? ball : bead;
  }

  /// Whether a point of a surface with this normal, both in the frame of a camera, sees the light.
  [[nodiscard]] bool is_lit(const Eigen::Vector3d& point,
                            const Eigen::Vector3d& normal,
                            const Eigen::Vector3d& light,
                            const Eigen::Isometry3d& camera) const {
    constexpr double kLeastCosine = 0.3;
    const Eigen::Vector3d to_light = (light - point).normalized();
    if (normal.dot(to_light) < kLeastCosine || -normal.dot(point.normalized()) < kLeastCosine)
      return false;
    const Eigen::Vector3d from_bead = camera * bead_mm - point;
    return from_bead.norm() < 1.5 * bead_radius_mm ||  // of the bead itself
           std::isnan(distance_to(from_bead, bead_radius_mm, to_light));
  }

  [[nodiscard]] AbsolutePhase phase_of(const Rig& seen,
                                       const Pattern& pattern,
                                       std::size_t camera) const {
    const auto pixels = rays_of(seen.reference().model);
    AbsolutePhase out{pattern,
                      Image<float>(pixels.width(), pixels.height(), kMissing),
                      Image<float>(pixels.width(), pixels.height(), kMissing),
                      Image<PixelStatus>(pixels.width(), pixels.height(), PixelStatus::Measured),
                      {}};
    if (options.harmonic_rad > 0.0)
      out.systematic_rad = Image<float>(pixels.width(), pixels.height(), kMissing);
    const Eigen::Isometry3d pose = camera == 0 ? Eigen::Isometry3d::Identity() : truth_from_rig();
    for (int y = 0; y < pixels.height(); ++y) {
      for (int x = 0; x < pixels.width(); ++x) {
        const Eigen::Vector2d ray = pixels(x, y).cast<double>();
        const double depth = depth_of(ray, pose);
        if (std::isnan(depth)) continue;
        const Eigen::Vector3d point = depth * ray.homogeneous();
        const Eigen::Vector3d from_bead = point - pose * bead_mm;
        const Eigen::Vector3d from_center =
            from_bead.norm() < 1.5 * bead_radius_mm ? from_bead : point - pose * center_mm;
        if (!is_lit(point, from_center.normalized(), seen.projector.position_mm, pose)) continue;
        const double phase = phase_at(point, pattern, seen.projector);
        const auto stream = hash(hash(7 + camera, static_cast<std::uint64_t>(pattern.direction)),
                                 static_cast<std::uint64_t>(y * pixels.width() + x));
        out.phase_rad(x, y) =
            static_cast<float>(phase + options.harmonic_rad * std::sin(4.0 * phase) +
                               kSigma_rad * normal_from(stream));
        out.sigma_rad(x, y) = static_cast<float>(kSigma_rad);
        if (options.harmonic_rad > 0.0)
          out.systematic_rad(x, y) = static_cast<float>(options.harmonic_rad / std::sqrt(2.0));
      }
    }
    return out;
  }

  [[nodiscard]] Eigen::Isometry3d truth_from_rig() const {
    PosedCamera second = rig.cameras[1];
    second.rotation = looking_at(second.position_mm, center_mm);
    return second.camera_from_rig();
  }

  TwoCameraOptions options;
  Rig rig;
  Eigen::Vector3d center_mm;
  double radius_mm = 0.0;
  Eigen::Vector3d bead_mm = {4.0, 3.0, 400.0};
  double bead_radius_mm = 0.0;
  std::vector<Pattern> patterns;
  std::vector<Rig> rigs;
  std::vector<Image<Eigen::Vector2f>> rays;
  std::array<std::vector<AbsolutePhase>, 2> phases;
  std::vector<CameraPhases> cameras;
  std::vector<RangeGrid> ranges;
  std::vector<RangeGrid> alone;  ///< before fusion
};

/// Errors of a camera's points along their rays.
struct Errors {
  std::size_t points = 0;
  double rms_mm = 0.0;
  double mean_mm = 0.0;
  double over_sigma = 0.0;  ///< RMS of the error over the stated combined sigma
};

inline Errors errors_of(const TwoCameras& scene,
                        std::size_t camera,
                        const std::vector<RangeGrid>& ranges) {
  Errors out;
  const RangeGrid& range = ranges[camera];
  const Eigen::Isometry3d pose =
      camera == 0 ? Eigen::Isometry3d::Identity() : scene.truth_from_rig();
  for (int y = 0; y < range.depth_mm.height(); ++y) {
    for (int x = 0; x < range.depth_mm.width(); ++x) {
      const RangePixel pixel = range.pixel(x, y);
      if (std::isnan(pixel.depth_mm)) continue;
      const Eigen::Vector2d ray = scene.rays[camera](x, y).cast<double>();
      const double error = ray.homogeneous().norm() *
                           (static_cast<double>(pixel.depth_mm) - scene.depth_of(ray, pose));
      const double systematic =
          std::isnan(pixel.systematic_mm) ? 0.0 : static_cast<double>(pixel.systematic_mm);
      ++out.points;
      out.mean_mm += error;
      out.rms_mm += error * error;
      out.over_sigma +=
          std::pow(error / std::hypot(static_cast<double>(pixel.sigma_mm), systematic), 2);
    }
  }
  const auto count = static_cast<double>(out.points);
  out.mean_mm /= count;
  out.rms_mm = std::sqrt(out.rms_mm / count);
  out.over_sigma = std::sqrt(out.over_sigma / count);
  return out;
}

}  // namespace frangia::testing
