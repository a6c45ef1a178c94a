#include "frangia/rig/fringe_parallax.h"

#include <cmath>
#include <variant>

#include "frangia/rig/crossing_of_axes.h"

namespace frangia {

double fringe_parallax_px(const Rig& rig, FringeDirection direction) {
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  const double baseline_mm = rig.projector.position_mm.norm();
  if (pinhole == nullptr || rig.projector.is_label || !(baseline_mm > 0.0)) return 0.0;
  constexpr double kFartherShare = 0.01;
  constexpr double kUsualDistance = 3.0;  // baselines, for axes that do not meet before the camera
  const CameraModel& camera = rig.reference().model;
  const Eigen::Vector3d ray =
      camera.ray({0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)}).homogeneous();
  double depth_mm = crossing_of_axes(rig).z();
  if (!(depth_mm > 0.0)) depth_mm = kUsualDistance * baseline_mm;
  const auto seen_at = [&](double depth) {
    return pinhole->project(rig.projector.from_rig(depth * ray));
  };
  const Eigen::Vector2d moved = seen_at((1.0 + kFartherShare) * depth_mm) - seen_at(depth_mm);
  return std::abs(direction == FringeDirection::Vertical ? moved.x() : moved.y());
}

FringeDirection measuring_direction(const Rig& rig) {
  const double vertical = fringe_parallax_px(rig, FringeDirection::Vertical);
  const double horizontal = fringe_parallax_px(rig, FringeDirection::Horizontal);
  return horizontal > vertical ? FringeDirection::Horizontal : FringeDirection::Vertical;
}

bool lacks_parallax(const Rig& rig, FringeDirection direction) {
  constexpr double kNextToNothing = 0.05;
  const bool vertical = direction == FringeDirection::Vertical;
  const FringeDirection other = vertical ? FringeDirection::Horizontal : FringeDirection::Vertical;
  return fringe_parallax_px(rig, direction) < kNextToNothing * fringe_parallax_px(rig, other);
}

}  // namespace frangia
