#pragma once

#include "frangia/core/run.h"
#include "frangia/rig/lens.h"
#include "frangia/surface/mesh.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct PasteOptions {
  double voxel_mm =
      0.0;  ///< edge of a voxel; 0 chooses it from the data's own sampling, and notes it
  double min_z_mm =
      0.0;  ///< nothing below this height of the object frame, when `clip_below` is set
  bool clip_below = false;
};

/// All views pasted into one mesh, each point weighted by 1/sigma^2.
///
/// units    mm, object frame
/// missing  where no view saw the surface the mesh stays open: nothing is invented
/// errors   Error(Input) when no view holds a point
/// source   signed distance in a hashed grid: Curless & Levoy 1996, Niessner et al. 2013
[[nodiscard]] Mesh paste_views(const ViewStore& views,
                               const Lens& camera,
                               const PasteOptions& options = {},
                               const Run& run = {});

}  // namespace frangia
