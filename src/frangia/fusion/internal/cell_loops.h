#pragma once

#include <array>
#include <cstdint>

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

}  // namespace frangia
