#pragma once

#include <cstddef>

#include "frangia/fusion/internal/measure_sampling.h"

namespace frangia {

/// How many blocks of voxels there is memory for.
struct VoxelBudget {
  double voxel_mm = 0.0;
  std::size_t max_blocks = 0;

  /// errors   Error(Input) that names a size that fits, when `blocks` are too many
  void check(double blocks) const;
  /// The same before any block is made: one view alone cannot need more than all of them.
  void check(const Sampling& sampling, std::size_t views) const;
};

/// shape    `max_memory_mb` 0 is half of the machine's
[[nodiscard]] VoxelBudget voxel_budget(double voxel_mm, std::size_t max_memory_mb);

}  // namespace frangia
