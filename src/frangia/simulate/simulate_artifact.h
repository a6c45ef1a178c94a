#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// Captures of an artifact for calibration.
struct ArtifactPlan {
  std::filesystem::path folder;      ///< scan folder to write
  Rig rig;                           ///< the true rig
  Artifact artifact = Plate{};       ///< a screen, a plate, or the ball bar of `make_part`
  int views = 13;                    ///< poses of a screen, or angles of the turntable
  double turn_rad = 2.1;             ///< of the turntable, from the first to the last view
  double max_tilt_rad = 0.5;         ///< of a screen against the plane across the camera's axis
  double start_error = 0.05;         ///< relative error of the lengths and the pitch in rig.toml
  double start_error_rad = 0.05236;  ///< error of the directions in rig.toml
  PatternPlan patterns;              ///< of the projector, or of the screen in its pixels
};

/// Renders an artifact into a scan folder: a screen in several poses, before the camera; a plate or
/// a ball bar that stands on the turntable at several angles.
///
/// rig.toml holds what is known before calibration: for a screen the size of the camera; for the
/// others the camera, and projector, turntable and laser sheet with the errors of the plan. The
/// true rig is written to truth-rig.toml.
/// @errors   Error(Input) when the rig has no turntable, for an artifact of which there is no part,
///           or as `simulate_scan`
[[nodiscard]] Scan simulate_artifact(const ArtifactPlan& plan,
                                     const SimulateOptions& options = {},
                                     const Run& run = {});

}  // namespace frangia
