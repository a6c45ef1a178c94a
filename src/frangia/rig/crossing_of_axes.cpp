#include "frangia/rig/crossing_of_axes.h"

#include <variant>

#include "frangia/core/solve_symmetric.h"

namespace frangia {
namespace {

/// Unit vector through the middle of an image.
Eigen::Vector3d middle_ray(const CameraModel& model) {
  const Eigen::Vector2d middle(0.5 * (model.width_px - 1), 0.5 * (model.height_px - 1));
  return model.ray(middle).homogeneous().normalized();
}

}  // namespace

Eigen::Vector3d crossing_of_axes(const Rig& rig) {
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  const Eigen::Vector3d forward =
      pinhole != nullptr ? middle_ray(*pinhole) : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d camera = middle_ray(rig.reference().model);
  const Eigen::Vector3d light = rig.projector.rotation.transpose() * forward;
  Eigen::Matrix<double, 3, 2> directions;
  directions << camera, -light;
  const Eigen::Vector2d distances = solve_symmetric(
      directions.transpose() * directions, directions.transpose() * rig.projector.position_mm);
  return 0.5 * (distances[0] * camera + rig.projector.position_mm + distances[1] * light);
}

}  // namespace frangia
