#include "frangia/service/arrange_rig.h"

#include <cmath>
#include <variant>

#include "frangia/core/error.h"

namespace frangia {
namespace {

double positive(const std::optional<double>& value, const char* refusal) {
  require(std::isfinite(*value) && *value > 0.0, refusal);
  return *value;
}

void set_focal(CameraModel& model, double focal_px) {
  model.focal_px *= focal_px / model.focal_px.x();
}

/// The rotation of the projector at a new place that keeps a target where it was in its field.
Eigen::Matrix3d aimed(const Projector& before,
                      const Eigen::Vector3d& old_target_mm,
                      const Eigen::Vector3d& position_mm,
                      const Eigen::Vector3d& target_mm) {
  const Eigen::Vector3d old_way = old_target_mm - before.position_mm;
  const Eigen::Vector3d way = target_mm - position_mm;
  return before.rotation * Eigen::Quaterniond::FromTwoVectors(way, old_way).toRotationMatrix();
}

}  // namespace

Rig arrange_rig(Rig rig, const RigArrangement& wanted) {
  const Rig before = rig;
  if (wanted.camera_focal_px)
    set_focal(rig.reference().model,
              positive(wanted.camera_focal_px, "camera_focal_px must be above 0"));
  if (wanted.projector_focal_px) {
    auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
    require(pinhole != nullptr,
            "projector_focal_px is of a digital projector; this rig has an interferometer");
    set_focal(*pinhole, positive(wanted.projector_focal_px, "projector_focal_px must be above 0"));
  }
  if (wanted.distance_mm) {
    const double distance = positive(wanted.distance_mm, "distance_mm must be above 0");
    require(rig.turntable.has_value(), "distance_mm is to the turntable; this rig has none");
    rig.turntable->point_mm = distance * before.turntable->point_mm.normalized();
  }
  if (wanted.baseline_mm) {
    const double baseline = positive(wanted.baseline_mm, "baseline_mm must be above 0");
    require(before.projector.position_mm.norm() > 0.0,
            "baseline_mm: the projector stands at the camera, so that its direction is open");
    rig.projector.position_mm = baseline * before.projector.position_mm.normalized();
  }
  if (rig.turntable && (wanted.distance_mm || wanted.baseline_mm)) {
    rig.projector.rotation = aimed(before.projector,
                                   before.turntable->point_mm,
                                   rig.projector.position_mm,
                                   rig.turntable->point_mm);
  }
  rig.calibration.reset();
  return rig;
}

}  // namespace frangia
