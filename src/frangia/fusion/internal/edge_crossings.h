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

}  // namespace frangia
