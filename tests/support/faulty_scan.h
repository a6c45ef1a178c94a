#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/range/triangulate.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

#include "support/small_scan.h"

namespace frangia::testing {

/// What was true while one view was taken.
struct TrueView {
  double angle_rad = 0.0;  ///< of the table
  /// Motion of the part on the table since the first view, object frame.
  Eigen::Isometry3d part = Eigen::Isometry3d::Identity();
  /// Motion of the table's top against its bearing, object frame.
  Eigen::Isometry3d wobble = Eigen::Isometry3d::Identity();
  Rig rig;
};

/// A scan of views whose points are known without rendering: each pixel's ray meets the part, the
/// true projector gives its phase, with noise, and the stated rig triangulates it.
struct FaultyScan {
  Rig stated;
  Pattern pattern{.name = "fine", .shifts_rad = {0.0, 1.0, 2.0}};
  double phase_sigma_rad = 0.008;
  bool noisy = true;  ///< false: points as `phase_sigma_rad` states them, without their noise
  std::uint32_t seed = 1;
  std::vector<double> stated_angles_rad;
  std::vector<double> times_s;  ///< as the stations state them; empty: they do not
  std::vector<TrueView> views;

  /// Views all around on the digital rig with `divisor` times fewer pixels on a side.
  explicit FaultyScan(int count, int divisor = 4) : stated(small_rig("digital", divisor)) {
    pattern.period_px = 16.0;
    for (int i = 0; i < count; ++i) {
      stated_angles_rad.push_back(kTwoPi * i / count);
      views.push_back({.angle_rad = stated_angles_rad.back(), .rig = stated});
    }
  }

  [[nodiscard]] std::vector<Station> stations() const {
    std::vector<Station> all;
    for (std::size_t i = 0; i < stated_angles_rad.size(); ++i)
      all.push_back({stated_angles_rad[i], std::to_string(i + 1)});
    for (std::size_t i = 0; i < times_s.size(); ++i)
      all[i].time_s = times_s[i];
    return all;
  }
  [[nodiscard]] TurntableStations given(const std::vector<Station>& all) const {
    return {*stated.turntable, all, &stated, &pattern};
  }

  /// The part slides between view `before` - 1 and view `before`.
  void slide(std::size_t before, const Eigen::Isometry3d& by) {
    for (std::size_t i = before; i < views.size(); ++i)
      views[i].part = by * views[i].part;
  }
  void slide(std::size_t before, const Eigen::Vector3d& by_mm) {
    slide(before, Eigen::Isometry3d(Eigen::Translation3d(by_mm)));
  }
  /// One view alone was taken with the part elsewhere.
  void displace(std::size_t view, const Eigen::Isometry3d& by) {
    views[view].part = by * views[view].part;
  }
  void displace(std::size_t view, const Eigen::Vector3d& by_mm) {
    displace(view, Eigen::Isometry3d(Eigen::Translation3d(by_mm)));
  }
  /// The table turns by other angles than was commanded, in proportion.
  void scale_angles(double factor) {
    for (TrueView& view : views)
      view.angle_rad *= factor;
  }
  /// The rig states its turntable as exact.
  void state_exact() {
    Turntable& table = *stated.turntable;
    table.point_sigma_mm = table.axis_sigma_rad = table.angle_sigma_rad = 0.0;
  }
  /// The table's axis and angles as the rig does not state them.
  void misalign(double shift_mm, double tilt_rad, double angle_sigma_rad) {
    std::mt19937 random(seed + 77);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (TrueView& view : views) {
      Turntable& table = *view.rig.turntable;
      table.point_mm += shift_mm * Eigen::Vector3d(0.8, 0.0, 0.6);
      table.axis = Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitX()) * table.axis;
      if (&view != &views.front()) view.angle_rad += angle_sigma_rad * noise(random);
    }
  }
  /// The projector turns and shifts by a share of the given motion, which each view has of its own.
  void move_projector(double turn_rad,
                      double shift_mm,
                      const std::function<double(std::size_t)>& share_of) {
    const Eigen::Vector3d axis = Eigen::Vector3d(0.6, 1.0, 0.3).normalized();
    const Eigen::Vector3d way = Eigen::Vector3d(0.8, 0.3, 0.5).normalized();
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double share = share_of(i);
      Projector& projector = views[i].rig.projector;
      projector.rotation =
          Eigen::AngleAxisd(share * turn_rad, axis).toRotationMatrix() * projector.rotation;
      projector.position_mm += share * shift_mm * way;
    }
  }
  /// By a share that grows from 0 to 1.
  void drift_projector(double turn_rad, double shift_mm, bool all_through = false) {
    const auto last = static_cast<double>(views.size() - 1);
    move_projector(turn_rad, shift_mm, [&](std::size_t view) {
      return all_through ? 1.0 : static_cast<double>(view) / last;
    });
  }
  /// By a share that approaches 1 as the projector warms up.
  void warm_up_projector(double turn_rad, double shift_mm, double constant_views) {
    move_projector(turn_rad, shift_mm, [&](std::size_t view) {
      return 1.0 - std::exp(-static_cast<double>(view) / constant_views);
    });
  }
  /// From view `before` on the projector, the table or both, which the camera then sees, are
  /// elsewhere in the rig's frame, by a rotation about the camera and a shift.
  void knock(std::size_t before, double turn_rad, double shift_mm, bool projector, bool table) {
    const Eigen::Isometry3d by =
        Eigen::Translation3d(shift_mm * Eigen::Vector3d(0.6, -0.5, 0.62)) *
        Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(0.3, 1.0, 0.1).normalized());
    const Eigen::Isometry3d rig_from_object = stated.rig_from_object(0.0);
    for (std::size_t i = before; i < views.size(); ++i) {
      if (table) views[i].wobble = rig_from_object.inverse() * by * rig_from_object;
      if (!projector) continue;
      Projector& own = views[i].rig.projector;
      own.rotation = (own.rotation * by.linear().transpose()).eval();
      own.position_mm = by * own.position_mm;
    }
  }
  /// The table's top tilts and shifts at random in each view.
  void wobble(double tilt_rad, double shift_mm) {
    std::mt19937 random(seed + 99);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (TrueView& view : views) {
      const Eigen::Vector3d tilt(tilt_rad * noise(random), tilt_rad * noise(random), 0.0);
      const Eigen::Vector3d shift(
          shift_mm * noise(random), shift_mm * noise(random), shift_mm * noise(random));
      view.wobble = Eigen::Translation3d(shift) * Eigen::AngleAxisd(tilt.norm(), tilt.normalized());
    }
  }

  /// Pose of the part in the rig frame while a view was taken.
  [[nodiscard]] Eigen::Isometry3d rig_from_part(std::size_t view) const {
    const TrueView& own = views[view];
    return own.rig.rig_from_object(0.0) * own.wobble *
           (own.rig.rig_from_object(0.0).inverse() * own.rig.rig_from_object(own.angle_rad)) *
           own.part;
  }

  [[nodiscard]] ViewStore take(const RayScene& part) const {
    ViewStore store;
    for (std::size_t i = 0; i < views.size(); ++i)
      store.add(take(part, i));
    return store;
  }

  [[nodiscard]] View take(const RayScene& part, std::size_t index) const {
    const TrueView& own = views[index];
    const CameraModel& camera = stated.reference().model;
    View view{{Image<float>(camera.width_px, camera.height_px, kMissing),
               Image<float>(camera.width_px, camera.height_px, kMissing)},
              stated.rig_from_object(stated_angles_rad[index])};
    const Eigen::Isometry3d rig_from = rig_from_part(index);
    const Eigen::Isometry3d part_from_rig = rig_from.inverse();
    const Eigen::Vector3d light = part_from_rig * own.rig.projector.position_mm;
    const auto true_rays = rays_of(own.rig.reference().model);
    const auto rays = rays_of(camera);
    parallel_rows(camera.height_px, [&](int y) {
      std::mt19937 random(seed * 7919U + static_cast<std::uint32_t>(1000 * index) +
                          static_cast<std::uint32_t>(y) * 104729U);
      std::normal_distribution<double> noise(0.0, phase_sigma_rad);
      for (int x = 0; x < camera.width_px; ++x) {
        const double error_rad = noisy ? noise(random) : 0.0;
        const Eigen::Vector3d ray = true_rays(x, y).cast<double>().homogeneous();
        const Eigen::Vector3d along = part_from_rig.linear() * ray;
        const auto hit = part.first_hit(part_from_rig.translation(), along);
        if (!hit || hit->normal.dot(along.normalized()) > -0.15) continue;
        const Eigen::Vector3d point = part_from_rig.translation() + hit->distance * along;
        const Eigen::Vector3d off = point + 1e-3 * hit->normal;
        if (hit->normal.dot((light - point).normalized()) < 0.1 || part.occluded(off, light))
          continue;
        const double phase_rad = phase_at(rig_from * point, pattern, own.rig.projector);
        const RayDepth found = intersect_fringe(
            rays(x, y).cast<double>(), phase_rad + error_rad, pattern, stated.projector);
        if (std::isnan(found.depth_mm)) continue;
        view.range.depth_mm(x, y) = static_cast<float>(found.depth_mm);
        view.range.sigma_mm(x, y) =
            static_cast<float>(std::abs(found.mm_per_rad) * phase_sigma_rad *
                               rays(x, y).cast<double>().homogeneous().norm());
      }
    });
    return view;
  }
};
}  // namespace frangia::testing
