#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/block_index.h"
#include "frangia/fusion/internal/distance_field.h"

namespace frangia {

/// The topology of the surface in a cell, whose corners are 8 voxels.
///
/// Corner c is at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + o runs along axis a from the corner
/// at offset (o & 1, o >> 1) on axes (a + 1) % 3 and (a + 2) % 3. Face 2 a + s is the one at side s
/// of axis a. A loop is a closed curve in which the surface intersects the cell's faces. Each loop
/// gets one vertex.
struct CellLoops {
  static constexpr std::uint8_t kNone = 255;

  std::uint8_t count = 0;
  std::array<std::uint8_t, 12> loop_of_edge{};  ///< kNone where the edge is not crossed
  std::uint8_t pinched_faces = 0;               ///< bit f: one loop crosses face f twice
};

/// Returns the loops of each sign pattern, whose bit c is set when corner c is inside.
///
/// A face that is crossed four times is ambiguous; its two inside corners are always separated.
/// That depends on the face alone, so neighbouring cells agree and the surface is manifold.
[[nodiscard]] const std::array<CellLoops, 256>& cell_loops();

/// Returns the two corners of an edge, the lower one first.
[[nodiscard]] constexpr std::array<int, 2> edge_corners(int edge) {
  const int axis = edge / 4;
  const int low = ((edge & 1) << ((axis + 1) % 3)) | ((edge >> 1 & 1) << ((axis + 2) % 3));
  return {low, low | (1 << axis)};
}

/// The crossings of the surface with the edges of the voxel grid, and the cells it intersects.
///
/// @shape    blocks of 8^3, as in the field, but only those that the surface intersects; a cell,
///          and the edges towards +x, +y, +z, belong to the voxel at their low corner
/// @units    mm, object frame
/// @missing  a cell with a corner that has no distance has the sign pattern 0, like one without
///          surface
struct EdgeCrossings {
  struct Block {
    std::array<std::uint8_t, DistanceField::kVoxels> inside{};  ///< sign pattern, for `cell_loops`
    std::array<std::uint8_t, DistanceField::kVoxels>
        axes{};  ///< bit a: the edge along a is crossed
    std::array<std::uint16_t, DistanceField::kVoxels>
        crossings{};  ///< of the block, before this voxel
    std::array<std::uint16_t, DistanceField::kVoxels>
        vertices{};                      ///< of the block, before this voxel
    std::uint32_t crossings_before = 0;  ///< of all earlier blocks
    std::uint32_t vertices_before = 0;

    [[nodiscard]] std::uint32_t first_crossing(std::size_t voxel) const {
      return crossings_before + crossings[voxel];
    }
    [[nodiscard]] std::uint32_t first_vertex(std::size_t voxel) const {
      return vertices_before + vertices[voxel];
    }
  };

  double voxel_mm = 0.0;
  std::vector<Eigen::Vector3i> block_coords;
  std::vector<std::unique_ptr<const Block>> blocks;
  BlockIndex index;
  std::vector<Eigen::Vector3f> points_mm;  ///< one for each crossing
  std::vector<std::int8_t>
      outward;               ///< axis + 1; negative when the lower end of the edge is outside
  std::size_t vertices = 0;  ///< one for each loop

  /// Returns the first crossing of a block, or the number of crossings after the last block.
  [[nodiscard]] std::size_t first_of(std::size_t block) const {
    return block < blocks.size() ? blocks[block]->crossings_before : points_mm.size();
  }
  [[nodiscard]] std::size_t first_vertex_of(std::size_t block) const {
    return block < blocks.size() ? blocks[block]->vertices_before : vertices;
  }

  /// A voxel's block and its index in the block.
  struct Address {
    const Block* block = nullptr;  ///< null for a block that does not exist
    std::size_t voxel = 0;
  };

  /// A block and its 26 neighbours, for look-ups near its voxels without a search in the index.
  struct Neighborhood {
    std::array<const Block*, 27> blocks{};  ///< the block itself is in the middle, x runs fastest
    Eigen::Vector3i low = Eigen::Vector3i::Zero();  ///< the middle block's lowest voxel

    /// Returns the address of a voxel in one of the 27 blocks.
    [[nodiscard]] Address at(const Eigen::Vector3i& voxel) const {
      const Eigen::Vector3i from = voxel - low;
      const int block = ((from.x() + kBlockEdge) >> 3) + 3 * ((from.y() + kBlockEdge) >> 3) +
                        9 * ((from.z() + kBlockEdge) >> 3);
      const int within = (from.x() & 7) | (from.y() & 7) << 3 | (from.z() & 7) << 6;
      return {blocks[static_cast<std::size_t>(block)], static_cast<std::size_t>(within)};
    }
    /// Returns the crossing on the edge from `voxel` along `axis`, which must be crossed.
    [[nodiscard]] std::uint32_t crossing(const Eigen::Vector3i& voxel, int axis) const;
  };
  [[nodiscard]] Neighborhood neighborhood(std::size_t block) const;
};

/// Finds the crossings of the field's zero level, and the cells all of whose corners have a
/// distance.
///
/// An edge along which the distance changes by more than `max_step_voxels` is not crossed: its ends
/// belong to different surfaces.
[[nodiscard]] EdgeCrossings find_edge_crossings(const DistanceField& field,
                                                const FieldParameters& parameters = {});

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
