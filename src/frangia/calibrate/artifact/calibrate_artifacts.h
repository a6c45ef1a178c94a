#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/calibrate/artifact/find_balls.h"
#include "frangia/calibrate/artifact/solve_artifacts.h"
#include "frangia/calibrate/board/measure_light.h"
#include "frangia/calibrate/solve/solve_camera.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Options of a calibration by a screen, plates and balls.
struct CalibrateArtifactsOptions {
  RigSolveOptions camera;      ///< of the camera before a screen
  ArtifactSolveOptions solve;  ///< of projector and turntable
  int plate_sites = 64;        ///< on plates, along the longer side of the image
};

/// A rig calibrated by artifacts.
struct ArtifactCalibration {
  Rig rig;                                ///< with `calibration` filled, its covariance included
  std::optional<CameraSolution> camera;   ///< from a screen
  std::vector<ScreenView> screens;        ///< poses of the screen, as they were used
  std::optional<ArtifactSolution> table;  ///< from plates and balls
  std::vector<ArtifactCapture> captures;  ///< of plates and balls, as they were used
  std::vector<std::string> left_out;      ///< folders of views without the artifact
  double light_range = 0.0;               ///< of the sites on plates and balls
};

/// Calibrates the camera from poses of a screen, and projector, turntable and laser sheet from
/// plates and balls on the turntable; each scan holds one artifact.
///
/// The rig begins as `start`, or as that of the first scan of a plate or ball, which may be off by
/// some degrees and percent; a screen's camera replaces its own.
/// @errors   Error(Input) with the first fault found: an artifact or a fringe direction that is
///           missing, a start without position, rotation or turntable, or as `solve_camera` and
///           `solve_artifacts`
[[nodiscard]] ArtifactCalibration calibrate_artifacts(std::span<const Scan> scans,
                                                      const std::optional<Rig>& start = {},
                                                      const CalibrateArtifactsOptions& options = {},
                                                      const Run& run = {});

}  // namespace frangia
