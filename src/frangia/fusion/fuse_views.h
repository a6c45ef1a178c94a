#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

struct FusionOptions {
  double voxel_mm = 0.0;  ///< edge of a voxel; 0 chooses it from the data's sampling, and notes it
  std::size_t max_memory_mb = 0;  ///< of the surface while it is made; 0 is half of the machine's
  std::size_t min_component_triangles = 100;  ///< smaller parts, not joined to others, are dropped
};

/// All views pasted into one mesh, each point weighted by cos^2/sigma^2, with normals, sigma and
/// the number of views at each vertex.
///
/// The views are averaged as signed distances near the surface; then every place where that average
/// crosses zero is put to the views again: those that saw it say where it lies and how it slopes,
/// those that see through it vote it out. Sharp edges are kept: vertices lie where planes meet.
/// Memory holds one view, the next one's range, and the surface.
/// units    mm, object frame
/// missing  where no view saw the surface the mesh stays open: nothing is invented
/// errors   Error(Input) when no view holds a point, and when the voxels would need more memory
///          than there is: then it names a size that fits
/// source   signed distance in a hashed grid: Curless & Levoy 1996, Niessner et al. 2013; vertices:
///          Ju et al. 2002
[[nodiscard]] Mesh fuse_views(const ViewStore& views,
                              const CameraModel& camera,
                              const FusionOptions& options = {},
                              const Run& run = {});

}  // namespace frangia
