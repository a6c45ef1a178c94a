#include "frangia/rig/rig_of_camera.h"

namespace frangia {

std::size_t camera_count(const Rig& rig) {
  return 1 + rig.more_cameras.size();
}

const CameraModel& model_of_camera(const Rig& rig, std::size_t camera) {
  return camera == 0 ? rig.camera.model : rig.more_cameras.at(camera - 1).camera.model;
}

Eigen::Isometry3d camera_from_rig(const Rig& rig, std::size_t camera) {
  return camera == 0 ? Eigen::Isometry3d::Identity()
                     : rig.more_cameras.at(camera - 1).camera_from_rig();
}

Rig rig_of_camera(const Rig& rig, std::size_t camera) {
  Rig out = rig;
  out.more_cameras.clear();
  if (camera == 0) return out;
  const PosedCamera& posed = rig.more_cameras.at(camera - 1);
  const Eigen::Isometry3d to_camera = posed.camera_from_rig();
  out.camera = posed.camera;
  out.calibration.reset();
  out.projector.position_mm = to_camera * rig.projector.position_mm;
  out.projector.rotation = rig.projector.rotation * posed.rotation.transpose();
  if (out.laser_sheet) {
    out.laser_sheet->normal = posed.rotation * rig.laser_sheet->normal;
    out.laser_sheet->offset_mm =
        rig.laser_sheet->offset_mm - rig.laser_sheet->normal.dot(posed.position_mm);
  }
  if (out.turntable) {
    out.turntable->point_mm = to_camera * rig.turntable->point_mm;
    out.turntable->axis = posed.rotation * rig.turntable->axis;
    out.turntable->reference_mm = to_camera * rig.turntable->reference_mm;
  }
  return out;
}

}  // namespace frangia
