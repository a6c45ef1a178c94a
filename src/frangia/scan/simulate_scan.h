#pragma once

#include "frangia/core/run.h"
#include "frangia/scan/scan_folder.h"
#include "frangia/simulate/simulate_options.h"
#include "frangia/surface/mesh.h"

namespace frangia {

/// Renders a whole scan of a part into `plan.folder`, with the part itself beside it as truth.ply.
///
/// rig.toml tells what the rig's owner knows, not its faults. scan.toml is written last: a folder
/// without it was interrupted. Returns the scan as written.
/// units    the part in mm, object frame
/// errors   Error(Input) when the folder holds anything but an interrupted simulation, or as
///          make_simulated_scene and render_view; Error(File) when it cannot be written
[[nodiscard]] Scan simulate_scan(const Mesh& part,
                                 const Scan& plan,
                                 const SimulateOptions& options = {},
                                 const Run& run = {});

}  // namespace frangia
