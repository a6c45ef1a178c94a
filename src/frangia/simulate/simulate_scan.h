#pragma once

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {

/// Renders a whole scan of a part into `plan.folder`, with the part itself beside it as truth.ply.
///
/// rig.toml tells what the rig's owner knows, not its faults. scan.toml is written last: a folder
/// without it was interrupted. Returns the scan as written.
///
/// In a setup that `plan.part_poses` names, the part stands as they say; nobody knows that
/// afterwards: they go into truth-setups.toml, as scan.toml could have them, and not into
/// scan.toml. units    the part in mm, object frame errors   Error(Input) when the folder holds
/// anything but an interrupted simulation, or as
///          make_simulated_scene and render_view; Error(File) when it cannot be written
[[nodiscard]] Scan simulate_scan(const Mesh& part,
                                 const Scan& plan,
                                 const SimulateOptions& options = {},
                                 const Run& run = {});

/// The part tilted about the x axis, turned about the vertical, and set down on the table.
///
/// units    object frame: what takes the part from its place in `part` to the new one
[[nodiscard]] Eigen::Isometry3d pose_on_table(const Mesh& part, double tilt_rad, double turn_rad);

}  // namespace frangia
