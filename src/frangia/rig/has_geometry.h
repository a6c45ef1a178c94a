#pragma once

#include "frangia/rig/rig.h"

namespace frangia {

/// Returns whether points can be triangulated: the poses and lenses of camera and projector are
/// known. Without them, phases can still be decoded.
[[nodiscard]] inline bool has_geometry(const Rig& rig) {
  const auto knows_lens = [](const CameraModel& model) {
    return model.focal_px.allFinite() && model.principal_point_px.allFinite() &&
           model.focal_px.minCoeff() > 0.0;
  };
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  return knows_lens(rig.reference().model) && rig.projector.position_mm.allFinite() &&
         rig.projector.rotation.allFinite() && (pinhole == nullptr || knows_lens(*pinhole));
}

}  // namespace frangia
