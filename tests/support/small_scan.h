#pragma once

#include <filesystem>

#include "frangia/core/angles.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

namespace frangia::testing {

/// A camera of the same field with fewer pixels: each takes the place of `divisor` times `divisor`.
inline void make_coarser(CameraModel& model, int divisor) {
  model.width_px /= divisor;
  model.height_px /= divisor;
  model.focal_px /= divisor;
  model.principal_point_px = (model.principal_point_px.array() + 0.5) / divisor - 0.5;
}

/// A rig of the presets with fewer pixels in its cameras, so that tests take little time.
inline Rig small_rig(const std::string& preset, int divisor = 2) {
  Rig rig = rig_preset(preset);
  for (PosedCamera& posed : rig.cameras)
    make_coarser(posed.camera.model, divisor);
  return rig;
}

/// A simulated scan of a built-in part, made in `folder` by `small_rig`.
inline Scan small_scan(const std::filesystem::path& folder,
                       const std::string& part,
                       const std::string& preset,
                       int views,
                       const SimulateOptions& options = {.samples_per_px = 4},
                       int divisor = 2) {
  Scan plan;
  plan.folder = folder;
  plan.name = part;
  plan.rig = small_rig(preset, divisor);
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < views; ++i)
    plan.views.push_back({kTwoPi * i / views, "views/" + std::to_string(i)});
  return simulate_scan(make_part(part), plan, options);
}

}  // namespace frangia::testing
