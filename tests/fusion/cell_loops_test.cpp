#include "frangia/fusion/internal/cell_loops.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(CellLoops, RunThroughEveryCrossedEdgeAndNoOther) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    for (int edge = 0; edge < 12; ++edge) {
      const auto [low, high] = edge_corners(edge);
      const bool crossed = (inside >> low & 1U) != (inside >> high & 1U);
      const std::uint8_t loop = cell_loops()[inside].loop_of_edge[static_cast<std::size_t>(edge)];
      EXPECT_EQ(crossed, loop != CellLoops::kNone) << inside << " edge " << edge;
      if (crossed) {
        EXPECT_LT(loop, cell_loops()[inside].count);
      }
    }
  }
}

TEST(CellLoops, HaveThreeEdgesOrMore) {
  for (const CellLoops& loops : cell_loops()) {
    for (std::uint8_t loop = 0; loop < loops.count; ++loop) {
      EXPECT_GE(std::count(loops.loop_of_edge.begin(), loops.loop_of_edge.end(), loop), 3);
    }
  }
}

TEST(CellLoops, KeepOppositeInsideCornersApart) {
  EXPECT_EQ(cell_loops()[0b10000001].count, 2);  // across the cell
  EXPECT_EQ(cell_loops()[0b00001001].count, 2);  // across a face
  EXPECT_EQ(cell_loops()[0b01101001].count, 4);  // every other corner
}

TEST(CellLoops, JoinOppositeOutsideCornersAcrossAFaceAndMarkIt) {
  const CellLoops& loops = cell_loops()[0b11110110];  // corners 0 and 3, across face 4, are outside
  EXPECT_EQ(loops.count, 1);
  EXPECT_EQ(loops.pinched_faces, 1U << 4U);
}

}  // namespace
}  // namespace frangia
