#include "frangia/fusion/internal/find_quads.h"

#include <algorithm>
#include <cstddef>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/cell_loops.h"

namespace frangia {
namespace {

/// Offsets of the four cells around an edge along axis a, on axes a + 1 and a + 2,
/// counter-clockwise seen from the edge's upper end.
constexpr std::array<std::array<int, 2>, 4> kRing{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

Eigen::Vector3i cell_of(const Quad& quad, std::size_t corner) {
  Eigen::Vector3i cell = quad.voxel;
  cell[(quad.axis + 1) % 3] += kRing[corner % 4][0];
  cell[(quad.axis + 2) % 3] += kRing[corner % 4][1];
  return cell;
}

/// Whether the quad's side needs an additional vertex on its face. Of the two strands of surface
/// through a pinched face, the one around the inside corner that is lower along the face's first
/// axis gets it.
bool is_pinched(const EdgeCrossings::Neighborhood& around,
                const Quad& quad,
                std::size_t side,
                bool outside_is_up) {
  const int across = face_axis(quad, side);
  const Eigen::Vector3i one = cell_of(quad, side);
  const Eigen::Vector3i other = cell_of(quad, side + 1);
  const auto pinched = [&](const Eigen::Vector3i& cell, const Eigen::Vector3i& neighbour) {
    const auto address = around.at(cell);
    const int face = 2 * across + (neighbour[across] > cell[across] ? 1 : 0);
    return (cell_loops()[address.block->inside[address.voxel]].pinched_faces >> face & 1) != 0;
  };
  if (!pinched(one, other) || !pinched(other, one)) return false;
  Eigen::Vector3i inside = quad.voxel;
  if (!outside_is_up) inside[quad.axis] += 1;
  const int first = (across + 1) % 3;
  return inside[first] == face_low(quad, side)[first];
}

void add_quads(std::vector<Quad>& quads,
               const EdgeCrossings& crossings,
               const HermiteAccumulators& hermite,
               std::size_t block) {
  const EdgeCrossings::Block& cells = *crossings.blocks[block];
  const EdgeCrossings::Neighborhood around = crossings.neighborhood(block);
  for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (cells.axes[at] == 0) continue;
    Quad quad;
    quad.voxel =
        crossings.block_coords[block] * kBlockEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    quad.crossing = cells.first_crossing(at);
    for (quad.axis = 0; quad.axis < 3; ++quad.axis) {
      if ((cells.axes[at] >> quad.axis & 1) == 0) continue;
      bool whole = hermite.is_supported(quad.crossing);
      unsigned pinched = 0;
      for (std::size_t corner = 0; whole && corner < 4; ++corner) {
        const auto cell = around.at(cell_of(quad, corner));
        whole = cell.block != nullptr && cell.block->inside[cell.voxel] != 0;
        if (!whole) break;
        const int edge = 4 * quad.axis - kRing[corner][0] - 2 * kRing[corner][1];
        const CellLoops& shape = cell_loops()[cell.block->inside[cell.voxel]];
        quad.ring[corner] = cell.block->first_vertex(cell.voxel) +
                            shape.loop_of_edge[static_cast<std::size_t>(edge)];
        pinched |= shape.pinched_faces;
      }
      if (whole) {
        quad.pinched = 0;
        for (std::size_t side = 0; pinched != 0 && side < 4; ++side) {
          if (is_pinched(around, quad, side, crossings.outward[quad.crossing] > 0))
            quad.pinched = static_cast<std::uint8_t>(quad.pinched | 1U << side);
        }
        quads.push_back(quad);
      }
      ++quad.crossing;
    }
  }
}

}  // namespace

int face_axis(const Quad& quad, std::size_t side) {
  return (quad.axis + (side % 2 == 0 ? 1 : 2)) % 3;
}

Eigen::Vector3i face_low(const Quad& quad, std::size_t side) {
  return cell_of(quad, side).cwiseMax(cell_of(quad, side + 1));
}

Quads find_quads(const EdgeCrossings& crossings, const HermiteAccumulators& hermite) {
  constexpr std::size_t kChunk = 64;
  Quads quads((crossings.blocks.size() + kChunk - 1) / kChunk);
  parallel_chunks(crossings.blocks.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Quad>& part = quads[begin / kChunk];
    part.reserve(crossings.first_of(end) - crossings.first_of(begin));
    for (std::size_t block = begin; block < end; ++block)
      add_quads(part, crossings, hermite, block);
  });
  return quads;
}

}  // namespace frangia
