#include "frangia/fusion/internal/cell_loops.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <memory>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// Returns the edge between two neighbouring corners.
int edge_between(int one, int other) {
  const int low = one < other ? one : other;
  const int across = one ^ other;
  const int axis = across == 1 ? 0 : across == 2 ? 1 : 2;
  return 4 * axis + (low >> ((axis + 1) % 3) & 1) + 2 * (low >> ((axis + 2) % 3) & 1);
}

/// Returns the corners of a face in cyclic order.
std::array<int, 4> face_ring(int face) {
  const int axis = face / 2;
  const int base = (face & 1) << axis;
  const int b = 1 << ((axis + 1) % 3);
  const int c = 1 << ((axis + 2) % 3);
  return {base, base | b, base | b | c, base | c};
}

/// For each crossed edge, the edges it is connected to across its two faces.
struct EdgeLinks {
  std::array<std::array<int, 2>, 12> to{};
  std::array<int, 12> count{};

  void join(int one, int other) {
    to[static_cast<std::size_t>(one)]
      [static_cast<std::size_t>(count[static_cast<std::size_t>(one)]++)] = other;
    to[static_cast<std::size_t>(other)]
      [static_cast<std::size_t>(count[static_cast<std::size_t>(other)]++)] = one;
  }
};

EdgeLinks edge_links_of(unsigned inside) {
  EdgeLinks links;
  for (int face = 0; face < 6; ++face) {
    const auto ring = face_ring(face);
    std::array<int, 4> crossed{};
    int crossings = 0;
    const auto is_inside = [&](std::size_t i) { return (inside >> ring[i % 4] & 1U) != 0; };
    // Edge i of the ring lies between its corners i and i + 1.
    const auto edge = [&](std::size_t i) { return edge_between(ring[i % 4], ring[(i + 1) % 4]); };
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_inside(i) != is_inside(i + 1))
        crossed[static_cast<std::size_t>(crossings++)] = edge(i);
    }
    if (crossings == 2) links.join(crossed[0], crossed[1]);
    if (crossings < 4) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_inside(i)) links.join(edge(i + 3), edge(i));
    }
  }
  return links;
}

CellLoops loops_of(unsigned inside) {
  const EdgeLinks links = edge_links_of(inside);
  CellLoops loops;
  loops.loop_of_edge.fill(CellLoops::kNone);
  for (std::size_t start = 0; start < 12; ++start) {
    if (links.count[start] == 0 || loops.loop_of_edge[start] != CellLoops::kNone) continue;
    std::size_t edge = start;
    while (loops.loop_of_edge[edge] == CellLoops::kNone) {
      loops.loop_of_edge[edge] = loops.count;
      const auto next = static_cast<std::size_t>(links.to[edge][0]);
      const bool taken = loops.loop_of_edge[next] != CellLoops::kNone;
      edge = taken ? static_cast<std::size_t>(links.to[edge][1]) : next;
    }
    ++loops.count;
  }
  for (int face = 0; face < 6; ++face) {
    const auto ring = face_ring(face);
    bool one_loop = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto edge = static_cast<std::size_t>(edge_between(ring[i], ring[(i + 1) % 4]));
      const auto first = static_cast<std::size_t>(edge_between(ring[0], ring[1]));
      one_loop = one_loop && loops.loop_of_edge[edge] != CellLoops::kNone &&
                 loops.loop_of_edge[edge] == loops.loop_of_edge[first];
    }
    if (one_loop)
      loops.pinched_faces |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(face));
  }
  return loops;
}

}  // namespace

const std::array<CellLoops, 256>& cell_loops() {
  static const std::array<CellLoops, 256> table = [] {
    std::array<CellLoops, 256> all{};
    for (unsigned inside = 0; inside < 256; ++inside)
      all[inside] = loops_of(inside);
    return all;
  }();
  return table;
}

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
