#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/pixel_allocator.h"
#include "frangia/surface/crossings.h"
#include "frangia/surface/evidence.h"

namespace frangia {

/// The quad around one crossing. Side i lies between corners i and i + 1, on a face between two
/// cells.
struct Quad {
  std::array<std::uint32_t, 4> ring;
  std::uint32_t crossing;
  unsigned pinched;  ///< bit i: side i needs a vertex of its own on its face
  Eigen::Vector3i voxel;
  int axis;
};

using Quads = std::vector<Quad, PixelAllocator<Quad>>;

/// The axis across the face between the cells of corners i and i + 1.
[[nodiscard]] int face_axis(const Quad& quad, std::size_t side);

/// The face's lowest corner.
[[nodiscard]] Eigen::Vector3i face_low(const Quad& quad, std::size_t side);

/// A quad around each crossing that holds, where all four cells have surface: in a fixed order.
[[nodiscard]] Quads find_quads(const Crossings& crossings, std::span<const Evidence> evidence);

}  // namespace frangia
