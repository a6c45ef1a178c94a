#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Density and noise of the points of all views.
struct Sampling {
  std::size_t points = 0;
  double spacing_mm = 0.0;  ///< median distance between the points of neighbouring pixels
  double sigma_mm = 0.0;    ///< median, along the ray
};

/// Measures the sampling on every 16th row of each view.
///
/// @missing  all members are 0 when no view holds a point
/// @errors   Error(Input) when the size of a view differs from the camera's
[[nodiscard]] Sampling measure_sampling(const ViewStore& views,
                                        const CameraRays& camera,
                                        const Run& run = {});

/// The number of voxel blocks that fit into memory.
struct VoxelBudget {
  double voxel_mm = 0.0;
  std::size_t max_blocks = 0;

  /// @errors   Error(Input) when `blocks` exceeds the budget; the message names a voxel size that
  /// fits
  void check(double blocks) const;
  /// Checks a lower bound before any block is allocated: the blocks of one average view.
  ///
  /// @errors   as above
  void check(const Sampling& sampling, std::size_t views) const;
};

/// Returns the budget for a voxel size.
///
/// @shape    `max_memory_mb` 0 stands for half of the machine's memory
[[nodiscard]] VoxelBudget voxel_budget(double voxel_mm, std::size_t max_memory_mb);

}  // namespace frangia
