#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/files/range_scan.h"
#include "frangia/scan/finish_mesh.h"
#include "frangia/surface/mesh.h"
#include "frangia/surface/paste_views.h"
#include "frangia/views/register_poses.h"

namespace frangia {

struct PasteScansOptions {
  bool register_poses = true;  ///< refine the poses that the scans came with
  RegisterPosesOptions registration;
  PasteOptions paste;
  FinishOptions finish;
};

struct PastedScans {
  Mesh mesh;
  std::size_t points = 0;  ///< of all scans, as they are looked at
  std::optional<PosesReport> registration;
};

/// Range scans of other programs, registered and pasted as views are.
///
/// Each scan is looked at through a camera of our own, which stands before it where its triangles
/// face, with pixels as far apart as its points; its noise is estimated from how neighbours
/// scatter.
/// units    mm, the frame of the poses
/// errors   Error(Input) when a scan has no points, and as paste_views
[[nodiscard]] PastedScans paste_scans(const std::vector<RangeScan>& scans,
                                      const PasteScansOptions& options = {},
                                      const Run& run = {});

}  // namespace frangia
