#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/calibrate/artifact/calibrate_artifacts.h"
#include "frangia/calibrate/artifact/solve_artifacts.h"
#include "frangia/calibrate/solve/solve_camera.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Measures all poses of a screen.
///
/// @errors   Error(Input) when a direction is missing or a pattern is not one of the screen
[[nodiscard]] std::vector<ScreenView> measure_screen(const Scan& scan, const Run& run);

/// Finds a plate in all views of a scan, by the phase alone, and its approximate surface by the
/// rig.
///
/// @errors   Error(Input) when no view shows a plane
[[nodiscard]] ArtifactCapture measure_plate(const Scan& scan,
                                            const Rig& rig,
                                            const CalibrateArtifactsOptions& options,
                                            const Run& run);

/// Finds balls in all views of a scan by a rig that is right but for its scale.
///
/// @errors   Error(Input) when no view shows all balls
[[nodiscard]] ArtifactCapture measure_balls(const Scan& scan,
                                            const Rig& rig,
                                            const CalibrateArtifactsOptions& options,
                                            const Run& run);

/// The points of sites as the rig triangulates them.
///
/// @units    mm, rig frame
/// @missing  NaN where the light of vertical fringes is missing
[[nodiscard]] std::vector<Eigen::Vector3d> site_points(const std::vector<LightSite>& sites,
                                                       const Rig& rig);

/// The pose of the table at an angle, relative to that at angle 0: rig_from_rig.
[[nodiscard]] Eigen::Isometry3d table_turn(const Rig& rig, double angle_rad);

}  // namespace frangia
