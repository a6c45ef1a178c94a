#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/files/range_scan.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/pipeline/finish_mesh.h"
#include "frangia/registration/find_view_poses.h"
#include "frangia/registration/register_poses.h"

namespace frangia {

/// Where the poses of scans come from, before they are refined.
enum class ScanPoses {
  Auto,   ///< as they are when they can be right or a .conf gave them, else from the shape
  Given,  ///< as they are
  Shape   ///< found from the shape alone
};

struct MergeScansOptions {
  ScanPoses poses = ScanPoses::Auto;
  bool register_poses = true;  ///< refine the poses
  RegisterPosesOptions registration;
  FusionOptions fusion;
  FinishOptions finish;
};

struct MergedScans {
  Mesh mesh;
  std::size_t points = 0;                 ///< of all scans, as they are looked at
  std::optional<FoundPoses> found_poses;  ///< when poses were found from the shape
  std::optional<PosesReport> registration;
  /// Why the mesh must not be trusted, as one clause without a full stop; empty when it can be.
  std::string untrusted_reason{};
};

/// Range scans of other programs, registered and pasted as views are.
///
/// Each scan is looked at through a camera of our own, which stands before it where its triangles
/// face, with pixels as far apart as its points; its noise is estimated from how neighbours
/// scatter.
/// units    mm, the frame of the poses; that of the first scan placed when they were found
/// missing  a scan whose pose cannot be found is named and left out
/// errors   Error(Input) when a scan has no points or no pose can be found, and as fuse_views
[[nodiscard]] MergedScans merge_scans(const std::vector<RangeScan>& scans,
                                      const MergeScansOptions& options = {},
                                      const Run& run = {});

}  // namespace frangia
