#include "frangia/simulate/internal/move_views.h"

#include "frangia/core/random.h"

namespace frangia {
namespace {

constexpr std::uint64_t kWobbleStream = 3;
/// Distance at which a tilt of the table or of the projector moves as far as the shift does.
constexpr double kArm_mm = 57.3;  // 1 degree for 1 mm

}  // namespace

Eigen::Isometry3d pose_with_motion(const Rig& rig,
                                   double angle_rad,
                                   std::size_t view,
                                   const MotionFaults& faults,
                                   std::uint64_t seed) {
  angle_rad *= faults.table_scale;
  if (faults.lost_step_view > 0 && view >= faults.lost_step_view) angle_rad -= faults.lost_step_rad;
  Eigen::Isometry3d part = Eigen::Isometry3d::Identity();
  if (faults.slide_view > 0 && view >= faults.slide_view)
    part.translation() = faults.slide_mm * Eigen::Vector3d(0.8, 0.6, 0.0);
  if (faults.wobble_mm == 0.0) return rig.rig_from_object(angle_rad) * part;
  const std::uint64_t stream = hash(hash(seed, kWobbleStream), view);
  const auto random = [&](std::uint64_t i) {
    return faults.wobble_mm * normal_from(hash(stream, i));
  };
  const Eigen::Vector3d tilt = Eigen::Vector3d(random(0), random(1), 0.0) / kArm_mm;
  Eigen::Isometry3d top = Eigen::Isometry3d::Identity();
  top.linear() = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
  top.translation() = Eigen::Vector3d(random(2), random(3), random(4));
  const Eigen::Isometry3d bearing = rig.rig_from_object(0.0);
  return bearing * top * (bearing.inverse() * rig.rig_from_object(angle_rad)) * part;
}

Projector drift(Projector projector, double drift_mm, double share) {
  // Twice as far as a holder of the length of the arm bends.
  const double turn_rad = 0.5 * share * drift_mm / kArm_mm;
  const Eigen::Vector3d axis = Eigen::Vector3d(0.6, 1.0, 0.3).normalized();
  projector.rotation = Eigen::AngleAxisd(turn_rad, axis).toRotationMatrix() * projector.rotation;
  projector.position_mm += share * drift_mm * Eigen::Vector3d(0.8, 0.3, 0.5).normalized();
  return projector;
}

}  // namespace frangia
