#pragma once

#include <filesystem>

#include "frangia/core/angles.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

namespace frangia::testing {

/// A rig of the presets with a quarter of the camera's pixels, so that tests take little time.
inline Rig small_rig(const std::string& preset) {
  Rig rig = rig_preset(preset);
  const auto halve = [](CameraModel& model) {
    model.width_px /= 2;
    model.height_px /= 2;
    model.focal_px *= 0.5;
    model.principal_point_px = 0.5 * (model.principal_point_px.array() + 0.5) - 0.5;
  };
  halve(rig.camera.model);
  for (PosedCamera& posed : rig.more_cameras)
    halve(posed.camera.model);
  return rig;
}

/// A simulated scan of a built-in part, made in `folder`.
inline Scan small_scan(const std::filesystem::path& folder,
                       const std::string& part,
                       const std::string& preset,
                       int views,
                       const SimulateOptions& options = {.samples_per_px = 4}) {
  Scan plan;
  plan.folder = folder;
  plan.name = part;
  plan.rig = small_rig(preset);
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < views; ++i)
    plan.views.push_back({kTwoPi * i / views, "views/" + std::to_string(i)});
  return simulate_scan(make_part(part), plan, options);
}

}  // namespace frangia::testing
