#include "frangia/calibrate/internal/rig_model.h"

#include <algorithm>

namespace frangia {

std::array<double, 9> intrinsics_block(const CameraModel& model) {
  return {model.focal_px.x(),
          model.focal_px.y() / model.focal_px.x(),
          model.principal_point_px.x(),
          model.principal_point_px.y(),
          model.distortion[0],
          model.distortion[1],
          model.distortion[2],
          model.distortion[3],
          model.distortion[4]};
}

CameraModel with_intrinsics(CameraModel model, const std::array<double, 9>& values) {
  model.focal_px = {values[0], values[0] * values[1]};
  model.principal_point_px = {values[2], values[3]};
  std::copy(values.begin() + 4, values.end(), model.distortion.begin());
  return model;
}

}  // namespace frangia
