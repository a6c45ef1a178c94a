#include "frangia/range/calibration_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/internal/changed_rigs.h"
#include "frangia/range/internal/phase_sample.h"

namespace frangia {
CalibrationUncertainty::CalibrationUncertainty(const Rig& rig,
                                               const Pattern& pattern,
                                               const MeasuredVolume& volume,
                                               std::size_t camera) {
  if (!rig.calibration || rig.calibration->covariance.empty() || volume.points_mm.empty()) return;
  const ChangedRigs rigs(rig, pattern, camera);
  if (rigs.changes() == 0) return;
  const RigidMotions rigid = fit_rigid(volume, rigs);
  const Eigen::Isometry3d rig_from_camera = rig.cameras[camera].camera_from_rig().inverse();
  const CameraModel& model = rig.cameras[camera].camera.model;
  low_.setConstant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low_;
  for (const Eigen::Vector3d& in_rig : volume.points_mm) {
    const Eigen::Vector3d point = rig_from_camera.inverse() * in_rig;
    const Eigen::Vector2d pixel = model.project(point);
    const Eigen::Array3d at(pixel.x(), pixel.y(), point.z());
    low_ = low_.min(at);
    high = high.max(at);
  }
  constexpr double kLeastStep = 1e-9;  // px or mm; keeps the step of a flat volume above zero
  step_ = ((high - low_) / (node_counts() - 1.0)).max(kLeastStep);
  constexpr int kCount = kNodes[0] * kNodes[1] * kNodes[2];
  Eigen::MatrixXd nodes(3 * rigs.changes(), kCount);
  parallel_chunks(kCount, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto index = static_cast<int>(i);
      const Eigen::Array3i place(
          index % kNodes[0], index / kNodes[0] % kNodes[1], index / (kNodes[0] * kNodes[1]));
      const Eigen::Array3d at = low_ + step_ * place.cast<double>();
      const Eigen::Vector3d in_camera = at.z() * model.ray({at.x(), at.y()}).homogeneous();
      const Eigen::Vector3d point = rig_from_camera * in_camera;
      const Displacements rest = rigs.displacements_of(point) - rigid.design(point) * rigid.motions;
      nodes.col(index) = (rig_from_camera.linear().transpose() * rest).reshaped();
    }
  });
  fill_missing(nodes, kNodes);
  displacements_mm_ = principal_displacements(nodes);
}

Eigen::Array3d CalibrationUncertainty::place_of(double x_px, double y_px, double depth_mm) const {
  return ((Eigen::Array3d(x_px, y_px, depth_mm) - low_) / step_).max(0.0).min(node_counts() - 1.0);
}

double CalibrationUncertainty::along_ray_mm(const Eigen::Vector3d& point_mm,
                                            const Eigen::Vector2d& pixel) const {
  if (displacements_mm_.size() == 0) return 0.0;
  const Eigen::Array3d place = place_of(pixel.x(), pixel.y(), point_mm.z());
  const Eigen::Array3d first = place.floor().min(node_counts() - 2.0);
  const Eigen::Array3d along = place - first;
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(displacements_mm_.rows(), 3);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3d upper(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const Eigen::Array3i at = (first + upper).cast<int>();
    const double share = (upper * along + (1.0 - upper) * (1.0 - along)).prod();
    sum += static_cast<float>(share) *
           displacements_mm_.middleCols(3 * node(at.x(), at.y(), at.z()), 3);
  }
  return static_cast<double>((sum * point_mm.normalized().cast<float>()).norm());
}

namespace {

/// What a displacement of the surface is multiplied with to yield the distance along the ray by
/// which the surface moves there: n / (n . r), with n the normal and r the unit ray. Without a
/// normal, the ray itself.
Eigen::Vector3f along_ray_by(const Image<float>& depth_mm,
                             const Image<Eigen::Vector2f>& rays,
                             int x,
                             int y) {
  constexpr int kReach = 2;             // pixels: across the noise of one
  constexpr float kLeastCosine = 0.1F;  // of ray and normal; steeper, the two pixels see two faces
  const Eigen::Vector3f ray = rays(x, y).homogeneous().normalized();
  if (x < kReach || y < kReach || x + kReach >= rays.width() || y + kReach >= rays.height())
    return ray;
  const auto point = [&](int column, int row) -> Eigen::Vector3f {
    return depth_mm(column, row) * rays(column, row).homogeneous();
  };
  const Eigen::Vector3f normal = (point(x + kReach, y) - point(x - kReach, y))
                                     .cross(point(x, y + kReach) - point(x, y - kReach))
                                     .normalized();
  const float cosine = normal.dot(ray);
  if (!(std::abs(cosine) > kLeastCosine)) return ray;
  return normal / cosine;
}

}  // namespace

Image<float> CalibrationUncertainty::along_rays_mm(const Image<float>& depth_mm,
                                                   const Image<Eigen::Vector2f>& rays) const {
  if (displacements_mm_.size() == 0) return {};
  const int width = depth_mm.width();
  Image<float> out(width, depth_mm.height(), kMissing);
  const Eigen::Index components = displacements_mm_.rows();
  parallel_rows(depth_mm.height(), [&](int y) {
    const double row = place_of(0.0, y, 0.0).y();
    const int upper = std::min(static_cast<int>(row), kNodes[1] - 2);
    const auto down = static_cast<float>(row - upper);
    // The nodes interpolated at this row, with those along depth side by side.
    Eigen::MatrixXf nodes(components, 3 * kNodes[0] * kNodes[2]);
    for (int z = 0; z < kNodes[2]; ++z) {
      for (int x = 0; x < kNodes[0]; ++x) {
        nodes.middleCols<3>(3 * (x * kNodes[2] + z)) =
            (1.0F - down) * displacements_mm_.middleCols<3>(3 * node(x, upper, z)) +
            down * displacements_mm_.middleCols<3>(3 * node(x, upper + 1, z));
      }
    }
    Eigen::VectorXf moved(components);
    for (int x = 0; x < width; ++x) {
      const float depth = depth_mm(x, y);
      if (std::isnan(depth)) continue;
      const Eigen::Vector3f by = along_ray_by(depth_mm, rays, x, y);
      const Eigen::Array3d place = place_of(x, y, static_cast<double>(depth));
      const int left = std::min(static_cast<int>(place.x()), kNodes[0] - 2);
      const int near = std::min(static_cast<int>(place.z()), kNodes[2] - 2);
      const auto right = static_cast<float>(place.x() - left);
      const auto far = static_cast<float>(place.z() - near);
      moved.setZero();
      for (const int column : {0, 1}) {
        for (const int layer : {0, 1}) {
          const float share =
              (column == 0 ? 1.0F - right : right) * (layer == 0 ? 1.0F - far : far);
          const int corner = (left + column) * kNodes[2] + near + layer;
          moved.noalias() += nodes.middleCols<3>(3 * corner) * (share * by);
        }
      }
      out(x, y) = moved.norm();
    }
  });
  return out;
}

namespace {

/// A rig and the two ways in which it measures a point.
struct TwoWays {
  Rig rig;
  Pattern first_pattern;
  Pattern second_pattern;
  ChangedRigs first;
  ChangedRigs second;

  TwoWays(const Rig& measured,
          Pattern one,
          Pattern other,
          std::size_t first_camera,
          std::size_t second_camera)
      : rig(measured),
        first_pattern(std::move(one)),
        second_pattern(std::move(other)),
        first(rig, first_pattern, first_camera),
        second(rig, second_pattern, second_camera) {}
};

bool has_covariance(const Rig& rig) {
  return rig.calibration && !rig.calibration->covariance.empty();
}

/// Two points of the stated uncertainty; empty without one.
DifferenceUncertainty of_two_points(const Rig& rig) {
  if (!rig.calibration || !(rig.calibration->point_sigma_mm > 0.0)) return {};
  const double apart_mm = std::sqrt(2.0) * rig.calibration->point_sigma_mm;
  return [apart_mm](const Eigen::Vector3d& /*point_mm*/) { return apart_mm; };
}

}  // namespace

DifferenceUncertainty between_directions(const Rig& rig,
                                         const Pattern& first,
                                         const Pattern& second) {
  if (!has_covariance(rig)) return of_two_points(rig);
  const auto ways = std::make_shared<const TwoWays>(rig, first, second, 0, 0);
  return [ways](const Eigen::Vector3d& point_mm) {
    const Displacements apart =
        ways->first.displacements_of(point_mm) - ways->second.displacements_of(point_mm);
    return (point_mm.normalized().transpose() * apart).norm();
  };
}

DifferenceUncertainty between_cameras(const Rig& rig,
                                      const Pattern& pattern,
                                      std::size_t own,
                                      std::size_t other) {
  if (!has_covariance(rig)) return of_two_points(rig);
  const Eigen::Isometry3d rig_from_own = rig.cameras[own].camera_from_rig().inverse();
  if (rig.projector.is_label) {
    const auto rays = std::make_shared<const ChangedRays>(rig);
    return [rays, rig_from_own, own, other](const Eigen::Vector3d& point_mm) {
      return rays->distances_of(rig_from_own * point_mm, own, other).norm();
    };
  }
  const auto ways = std::make_shared<const TwoWays>(rig, pattern, pattern, own, other);
  return [ways, rig_from_own](const Eigen::Vector3d& point_mm) {
    const Eigen::Vector3d point = rig_from_own * point_mm;
    const Eigen::Vector3d ray = rig_from_own.linear() * point_mm.normalized();
    const Displacements apart =
        ways->first.displacements_of(point) - ways->second.displacements_of(point);
    return (ray.transpose() * apart).norm();
  };
}

}  // namespace frangia
