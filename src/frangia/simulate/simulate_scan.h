#pragma once

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// Renders a scan of a part into `plan.folder` and writes the part as truth.ply. Returns the scan
/// as written. Each camera of the rig records every view, with an exposure of its own.
///
/// rig.toml describes the rig without its faults, and states that a turntable without faults is
/// exact. scan.toml is written last: a folder without it is an interrupted simulation.
/// `plan.part_poses` are the true part poses of the setups; they are written to truth-setups.toml,
/// not to scan.toml.
///
/// @units    mm, object frame
/// @errors   Error(Input) when the folder holds anything but an interrupted simulation, when the
///          plan has no pattern or view, when an option is out of range, or when the rig cannot
///          show a pattern; Error(File) when a file cannot be written
[[nodiscard]] Scan simulate_scan(const Mesh& part,
                                 const Scan& plan,
                                 const SimulateOptions& options = {},
                                 const Run& run = {});

/// Returns the pose of a part that is tilted about the x axis, turned about the z axis, and put
/// down centred on the turntable.
///
/// @units    mm, object frame: pose * (point of `part`) = posed point
[[nodiscard]] Eigen::Isometry3d pose_on_table(const Mesh& part, double tilt_rad, double turn_rad);

}  // namespace frangia
