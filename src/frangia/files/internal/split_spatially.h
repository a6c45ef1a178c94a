#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Splits triangles of a mesh into spatially compact groups of at most `max_count` triangles and
/// vertices, by recursive bisection at the median along the longest side.
///
/// @shape    `triangles` are indices into mesh.triangles; each is in exactly one group, ascending
/// @errors   Error(Input) when `max_count` is below 3
[[nodiscard]] std::vector<std::vector<std::uint32_t>> split_spatially(
    const Mesh& mesh, std::span<const std::uint32_t> triangles, std::size_t max_count);

/// The distinct vertices of triangles of a mesh, ascending.
[[nodiscard]] std::vector<std::uint32_t> vertices_of(const Mesh& mesh,
                                                     std::span<const std::uint32_t> triangles);

}  // namespace frangia
