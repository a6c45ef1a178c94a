#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "frangia/fusion/internal/distance_field.h"

namespace frangia {

/// Mean distances at the corners of a block's cells, which reach one voxel into the neighbouring
/// blocks.
///
/// @shape    9^3
/// @units    mm
/// @missing  NaN at a voxel without weight
struct CornerDistances {
  static constexpr int kSide = kBlockEdge + 1;
  std::array<float, std::size_t{kSide} * kSide * kSide> distance_mm{};

  static constexpr std::size_t at(int x, int y, int z) {
    const int coords = x + kSide * (y + kSide * z);
    return static_cast<std::size_t>(coords);
  }
};

/// Returns the index of a voxel within its block.
[[nodiscard]] constexpr std::size_t voxel_at(int x, int y, int z) {
  return static_cast<std::size_t>((x & 7) | (y & 7) << 3 | (z & 7) << 6);
}

/// Returns the distances at the corners of the cells of the block at `coords`.
[[nodiscard]] CornerDistances corner_distances(const DistanceField& field,
                                               const Eigen::Vector3i& coords);

/// Signs of a row of corners along x: bit x belongs to corner x.
struct RowBits {
  unsigned seen = 0;    ///< the corner has a distance
  unsigned inside = 0;  ///< the distance is negative
};
using CornerBits =
    std::array<std::array<RowBits, CornerDistances::kSide>, CornerDistances::kSide>;  ///< [z][y]

[[nodiscard]] CornerBits corner_bits(const CornerDistances& corners);

/// Returns bit x for each cell (x, y, z) that the surface may cross and whose corners all have a
/// distance.
[[nodiscard]] unsigned crossed_cells(const CornerBits& bits, std::size_t y, std::size_t z);

/// Returns bit x for each voxel (x, y, z) with an edge towards +x, +y or +z that the surface may
/// cross.
[[nodiscard]] unsigned crossed_edges(const CornerBits& bits, std::size_t y, std::size_t z);

}  // namespace frangia
