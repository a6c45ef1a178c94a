#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {

/// The quad around one crossing. Side i, between corners i and i + 1, crosses the face between two
/// cells.
struct Quad {
  std::array<std::uint32_t, 4> ring;  ///< counter-clockwise seen from the edge's upper end
  std::uint32_t crossing;
  Eigen::Vector3i voxel;
  std::uint8_t axis;
  std::uint8_t pinched;       ///< bit i: side i needs an additional vertex on its face
  std::uint8_t diagonal = 0;  ///< corner, 0 or 1, at which the diagonal starts
  bool folded = false;        ///< a triangle faces inward with either diagonal
};

/// Quads in the order of the blocks, in chunks of several blocks.
using Quads = std::vector<std::vector<Quad>>;

/// Returns the axis normal to the face between the cells of corners i and i + 1.
[[nodiscard]] int face_axis(const Quad& quad, std::size_t side);

/// Returns the lowest corner of that face.
[[nodiscard]] Eigen::Vector3i face_low(const Quad& quad, std::size_t side);

/// Returns the quads around all supported crossings whose four cells have surface.
[[nodiscard]] Quads find_quads(const EdgeCrossings& crossings, const HermiteAccumulators& hermite);

}  // namespace frangia
