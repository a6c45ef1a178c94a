#pragma once

#include <cstddef>

#include "frangia/fusion/internal/measure_sampling.h"

namespace frangia {

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
