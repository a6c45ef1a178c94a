#include "frangia/fusion/internal/edge_crossings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/corner_distances.h"

namespace frangia {
namespace {

/// The crossings of one block, before the offsets of the blocks are known.
struct BlockCrossings {
  std::unique_ptr<EdgeCrossings::Block> block = std::make_unique<EdgeCrossings::Block>();
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<std::int8_t> outward;
  std::uint32_t vertices = 0;
  std::size_t crossings_before = 0;  ///< of all earlier blocks; set by `assign_offsets`
};

/// Returns the sign pattern of a cell; 0 when a corner has no distance or an edge has a step.
std::uint8_t pattern_at(const CornerDistances& corners, int x, int y, int z, float max_step_mm) {
  std::array<float, 8> d{};
  unsigned inside = 0;
  for (int c = 0; c < 8; ++c) {
    const float value =
        corners.distance_mm[CornerDistances::at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
    if (std::isnan(value)) return 0;
    d[static_cast<std::size_t>(c)] = value;
    if (value < 0.0F) inside |= 1U << static_cast<unsigned>(c);
  }
  if (inside == 0 || inside == 255) return 0;
  for (int edge = 0; edge < 12; ++edge) {
    const auto [low, high] = edge_corners(edge);
    const float a = d[static_cast<std::size_t>(low)];
    const float b = d[static_cast<std::size_t>(high)];
    if ((a < 0.0F) != (b < 0.0F) && std::abs(a - b) > max_step_mm) return 0;
  }
  return static_cast<std::uint8_t>(inside);
}

void add_crossings(BlockCrossings& found,
                   const CornerDistances& corners,
                   const Eigen::Vector3i& voxel,
                   float edge_mm,
                   float max_step_mm) {
  const int x = voxel.x() & 7;
  const int y = voxel.y() & 7;
  const int z = voxel.z() & 7;
  const float here = corners.distance_mm[CornerDistances::at(x, y, z)];
  const std::size_t i = voxel_at(x, y, z);
  for (int axis = 0; axis < 3; ++axis) {
    const float there = corners.distance_mm[CornerDistances::at(
        x + (axis == 0 ? 1 : 0), y + (axis == 1 ? 1 : 0), z + (axis == 2 ? 1 : 0))];
    if (!((here < 0.0F) != (there < 0.0F) && std::abs(here - there) <= max_step_mm)) continue;
    Eigen::Vector3f point = voxel.cast<float>();
    point[axis] += here / (here - there);
    found.block->axes[i] |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(axis));
    found.points_mm.emplace_back(point * edge_mm);
    found.outward.push_back(static_cast<std::int8_t>(there < 0.0F ? -axis - 1 : axis + 1));
  }
}

std::unique_ptr<BlockCrossings> find_in_block(const DistanceField& field,
                                              const Eigen::Vector3i& coords,
                                              const FieldParameters& parameters) {
  const CornerDistances corners = corner_distances(field, coords);
  const CornerBits bits = corner_bits(corners);
  bool any_inside = false;
  bool any_outside = false;
  for (const auto& layer : bits) {
    for (const RowBits& row : layer) {
      any_inside = any_inside || row.inside != 0;
      any_outside = any_outside || (row.seen & ~row.inside) != 0;
    }
  }
  if (!any_inside || !any_outside) return nullptr;
  const auto edge_mm = static_cast<float>(field.voxel_mm);
  const float max_step_mm = static_cast<float>(parameters.max_step_voxels) * edge_mm;
  auto found = std::make_unique<BlockCrossings>();
  for (int row = 0; row < kBlockEdge * kBlockEdge; ++row) {
    const int y = row % kBlockEdge;
    const int z = row / kBlockEdge;
    const unsigned cells =
        crossed_cells(bits, static_cast<std::size_t>(y), static_cast<std::size_t>(z));
    const unsigned edges =
        crossed_edges(bits, static_cast<std::size_t>(y), static_cast<std::size_t>(z));
    for (int x = 0; x < kBlockEdge; ++x) {
      const std::size_t i = voxel_at(x, y, z);
      found->block->vertices[i] = static_cast<std::uint16_t>(found->vertices);
      found->block->crossings[i] = static_cast<std::uint16_t>(found->points_mm.size());
      if ((cells >> x & 1U) != 0) {
        found->block->inside[i] = pattern_at(corners, x, y, z, max_step_mm);
        found->vertices += cell_loops()[found->block->inside[i]].count;
      }
      if ((edges >> x & 1U) != 0) {
        add_crossings(
            *found, corners, coords * kBlockEdge + Eigen::Vector3i(x, y, z), edge_mm, max_step_mm);
      }
    }
  }
  const bool empty = found->points_mm.empty() && found->vertices == 0;
  return empty ? nullptr : std::move(found);
}

/// Numbers the crossings and vertices of all blocks and allocates the crossings.
EdgeCrossings assign_offsets(const DistanceField& field,
                             const std::vector<std::unique_ptr<BlockCrossings>>& parts) {
  EdgeCrossings all;
  all.voxel_mm = field.voxel_mm;
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i]) continue;
    BlockCrossings& part = *parts[i];
    part.crossings_before = crossings;
    part.block->crossings_before = static_cast<std::uint32_t>(crossings);
    part.block->vertices_before = static_cast<std::uint32_t>(all.vertices);
    all.index.add(block_key(field.block_coords[i]), static_cast<std::uint32_t>(all.blocks.size()));
    all.block_coords.push_back(field.block_coords[i]);
    all.blocks.push_back(std::move(part.block));
    crossings += part.points_mm.size();
    all.vertices += part.vertices;
  }
  all.points_mm.resize(crossings);
  all.outward.resize(crossings);
  return all;
}

}  // namespace

EdgeCrossings::Neighborhood EdgeCrossings::neighborhood(std::size_t block) const {
  Neighborhood around;
  around.low = block_coords[block] * kBlockEdge;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i coords =
        block_coords[block] + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const std::uint32_t found = index.find(block_key(coords));
    if (found != BlockIndex::kNone)
      around.blocks[static_cast<std::size_t>(i)] = blocks[found].get();
  }
  return around;
}

std::uint32_t EdgeCrossings::Neighborhood::crossing(const Eigen::Vector3i& voxel, int axis) const {
  const Address address = at(voxel);
  const unsigned lower =
      address.block->axes[address.voxel] & ((1U << static_cast<unsigned>(axis)) - 1U);
  return address.block->first_crossing(address.voxel) +
         static_cast<std::uint32_t>(std::popcount(lower));
}

EdgeCrossings find_edge_crossings(const DistanceField& field, const FieldParameters& parameters) {
  std::vector<std::unique_ptr<BlockCrossings>> parts(field.block_coords.size());
  parallel_chunks(parts.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      parts[i] = find_in_block(field, field.block_coords[i], parameters);
  });
  EdgeCrossings all = assign_offsets(field, parts);
  parallel_chunks(parts.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!parts[i]) continue;
      const auto first = static_cast<std::ptrdiff_t>(parts[i]->crossings_before);
      std::copy(
          parts[i]->points_mm.begin(), parts[i]->points_mm.end(), all.points_mm.begin() + first);
      std::copy(parts[i]->outward.begin(), parts[i]->outward.end(), all.outward.begin() + first);
      parts[i].reset();
    }
  });
  return all;
}

}  // namespace frangia
