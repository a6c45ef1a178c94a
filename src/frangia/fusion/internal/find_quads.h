#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {

/// The quad around one crossing. Side i lies between corners i and i + 1, on a face between two
/// cells.
struct Quad {
  std::array<std::uint32_t, 4> ring;  ///< counter-clockwise seen from the edge's upper end
  std::uint32_t crossing;
  Eigen::Vector3i voxel;
  std::uint8_t axis;
  std::uint8_t pinched;       ///< bit i: side i needs a vertex of its own on its face
  std::uint8_t diagonal = 0;  ///< corner, 0 or 1, that the cut into triangles starts at
  bool folded = false;        ///< a triangle faces inward, whatever the cut
};

/// As they are found, some blocks' together.
using Quads = std::vector<std::vector<Quad>>;

/// The axis across the face between the cells of corners i and i + 1.
[[nodiscard]] int face_axis(const Quad& quad, std::size_t side);

/// The face's lowest corner.
[[nodiscard]] Eigen::Vector3i face_low(const Quad& quad, std::size_t side);

/// A quad around each crossing that holds, where all four cells have surface: in a fixed order.
[[nodiscard]] Quads find_quads(const EdgeCrossings& crossings, const HermiteAccumulators& hermite);

}  // namespace frangia
