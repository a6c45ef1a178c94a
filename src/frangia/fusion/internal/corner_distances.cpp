#include "frangia/fusion/internal/corner_distances.h"

#include <cmath>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

/// A block and its neighbours towards +x, +y and +z; the bits of the index are the steps in x, y,
/// z.
using UpperNeighbors = std::array<const DistanceField::Block*, 8>;
UpperNeighbors upper_neighbors(const DistanceField& field, const Eigen::Vector3i& coords) {
  UpperNeighbors around{};
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t found = field.index.find(
        block_key(coords.x() + (i & 1), coords.y() + (i >> 1 & 1), coords.z() + (i >> 2)));
    if (found != BlockIndex::kNone) around[static_cast<std::size_t>(i)] = &field.blocks[found];
  }
  return around;
}

}  // namespace

CornerDistances corner_distances(const DistanceField& field, const Eigen::Vector3i& coords) {
  const UpperNeighbors around = upper_neighbors(field, coords);
  const auto distance_of = [](const DistanceField::Voxel& voxel) {
    return voxel.weight > 0.0F ? voxel.weighted_mm / voxel.weight : kMissing;
  };
  CornerDistances corners;
  corners.distance_mm.fill(kMissing);
  for (int z = 0; z <= kBlockEdge; ++z) {
    for (int y = 0; y <= kBlockEdge; ++y) {
      const auto row = static_cast<std::size_t>((y >> 3) << 1 | (z >> 3) << 2);
      float* to = &corners.distance_mm[CornerDistances::at(0, y, z)];
      if (const auto* block = around[row]) {
        const DistanceField::Voxel* from = &(*block)[voxel_at(0, y, z)];
        for (int x = 0; x < kBlockEdge; ++x)
          to[x] = distance_of(from[x]);
      }
      if (const auto* block = around[row | 1])
        to[kBlockEdge] = distance_of((*block)[voxel_at(0, y, z)]);
    }
  }
  return corners;
}

CornerBits corner_bits(const CornerDistances& corners) {
  CornerBits bits{};
  for (int z = 0; z <= kBlockEdge; ++z) {
    for (int y = 0; y <= kBlockEdge; ++y) {
      RowBits& row = bits[static_cast<std::size_t>(z)][static_cast<std::size_t>(y)];
      for (int x = 0; x <= kBlockEdge; ++x) {
        const float d = corners.distance_mm[CornerDistances::at(x, y, z)];
        row.seen |= static_cast<unsigned>(!std::isnan(d)) << static_cast<unsigned>(x);
        row.inside |= static_cast<unsigned>(d < 0.0F) << static_cast<unsigned>(x);
      }
    }
  }
  return bits;
}

unsigned crossed_cells(const CornerBits& bits, std::size_t y, std::size_t z) {
  unsigned seen = ~0U;
  unsigned any = 0;
  unsigned all = ~0U;
  for (const RowBits& row : {bits[z][y], bits[z][y + 1], bits[z + 1][y], bits[z + 1][y + 1]}) {
    seen &= row.seen & row.seen >> 1;
    any |= row.inside | row.inside >> 1;
    all &= row.inside & row.inside >> 1;
  }
  return seen & any & ~all;
}

unsigned crossed_edges(const CornerBits& bits, std::size_t y, std::size_t z) {
  const RowBits& row = bits[z][y];
  const auto differ = [&](unsigned seen, unsigned inside) {
    return row.seen & seen & (row.inside ^ inside);
  };
  const RowBits& next = bits[z][y + 1];
  const RowBits& above = bits[z + 1][y];
  return differ(row.seen >> 1, row.inside >> 1) | differ(next.seen, next.inside) |
         differ(above.seen, above.inside);
}

}  // namespace frangia
