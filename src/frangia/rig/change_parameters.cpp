#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/internal/parameter_names.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

using PoseChange = Eigen::Matrix<double, 6, 1>;

/// Adds to one of the nine intrinsic parameters.
void change_intrinsic(CameraModel& model, std::size_t which, double change) {
  const double ratio = model.focal_px.y() / model.focal_px.x();
  switch (which) {
    case 0:
      model.focal_px += change * Eigen::Vector2d(1.0, ratio);
      break;
    case 1:
      model.focal_px.y() += change * model.focal_px.x();
      break;
    case 2:
      model.principal_point_px.x() += change;
      break;
    case 3:
      model.principal_point_px.y() += change;
      break;
    default:
      model.distortion.at(which - 4) += change;
  }
}

/// Adds to the rotation vector and the translation of `p = R X + t`.
void change_pose(Eigen::Matrix3d& rotation,
                 Eigen::Vector3d& position_mm,
                 const PoseChange& changes) {
  if (changes.isZero(0.0)) return;
  const Eigen::Vector3d translation = -(rotation * position_mm);
  const Eigen::AngleAxisd turn(rotation);
  const Eigen::Vector3d vector = turn.angle() * turn.axis() + changes.head<3>();
  const double angle = vector.norm();
  rotation = angle > 0.0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                         : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  position_mm = -(rotation.transpose() * (translation + changes.tail<3>()));
}

template <std::size_t n>
std::size_t index_in(const std::array<const char*, n>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// What a device of a rig has; null for what it does not have.
struct ChangedDevice {
  CameraModel* model = nullptr;
  Eigen::Matrix3d* rotation = nullptr;
  Eigen::Vector3d* position_mm = nullptr;
  PoseChange pose = PoseChange::Zero();
};

/// The devices of a rig by the beginnings of the names of their parameters.
std::map<std::string, ChangedDevice, std::less<>> devices_of(Rig& rig) {
  std::map<std::string, ChangedDevice, std::less<>> devices;
  devices[std::string(kProjectorPrefix)] = {std::get_if<PinholeModel>(&rig.projector.model),
                                            &rig.projector.rotation,
                                            &rig.projector.position_mm};
  devices[std::string(kCameraPrefix)] = {&rig.reference().model};
  for (std::size_t i = 1; i < rig.cameras.size(); ++i) {
    PosedCamera& posed = rig.cameras[i];
    devices[camera_prefix(posed.camera.name)] = {
        &posed.camera.model, &posed.rotation, &posed.position_mm};
  }
  return devices;
}

/// The coefficient of the wavefront with a name; null for another name or projector.
double* wavefront_coefficient(Rig& rig, std::string_view name) {
  auto* angular = std::get_if<AngularModel>(&rig.projector.model);
  if (angular == nullptr) return nullptr;
  for (std::size_t i = 0; i < Wavefront::kTerms; ++i) {
    if (name == Wavefront::parameter_name(i)) return &angular->wavefront.coefficients_rad.at(i);
  }
  return nullptr;
}

}  // namespace

Rig change_parameters(const Rig& rig,
                      const std::vector<std::string>& names,
                      const Eigen::VectorXd& changes) {
  require(static_cast<std::size_t>(changes.size()) == names.size(),
          "change_parameters: there must be one change for each parameter");
  Rig changed = rig;
  auto devices = devices_of(changed);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double change = changes[static_cast<Eigen::Index>(i)];
    const std::string_view name = names[i];
    const std::size_t dot = std::min(name.find('.'), name.size() - 1) + 1;
    const auto device = devices.find(name.substr(0, dot));
    const std::size_t intrinsic = index_in(kIntrinsicNames, name.substr(dot));
    const std::size_t in_pose = index_in(kPoseNames, name.substr(dot));
    const bool known = device != devices.end();
    if (known && intrinsic < kIntrinsicNames.size() && device->second.model != nullptr) {
      change_intrinsic(*device->second.model, intrinsic, change);
    } else if (known && in_pose < kPoseNames.size() && device->second.rotation != nullptr) {
      device->second.pose[static_cast<Eigen::Index>(in_pose)] += change;
    } else if (name == kPitchScaleName && changed.projector.is_angular()) {
      std::get<AngularModel>(changed.projector.model).pitch_scale += change;
    } else if (double* coefficient = wavefront_coefficient(changed, name)) {
      *coefficient += change;
    } else {
      throw Error(ErrorKind::Input, fmt::format("'{}' is not a parameter of this rig", name));
    }
  }
  for (auto& [prefix, device] : devices) {
    if (device.rotation != nullptr) change_pose(*device.rotation, *device.position_mm, device.pose);
  }
  return changed;
}

}  // namespace frangia
