#include "frangia/rig/rig_of_camera.h"

namespace frangia {

Rig rig_of_camera(const Rig& rig, std::size_t camera) {
  Rig out = rig;
  const PosedCamera& posed = rig.cameras.at(camera);
  out.cameras = {PosedCamera{posed.camera}};
  if (camera == 0) return out;
  const Eigen::Isometry3d to_camera = posed.camera_from_rig();
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
