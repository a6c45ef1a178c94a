#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// The triangles of a mesh in groups that lie together, none larger than `most` in triangles or in
/// vertices. Each group is halved at the median of its longest side until it fits.
///
/// shape    `triangles` are indices into mesh.triangles; each is in exactly one group, ascending
/// errors   Error(Input) when `most` is below 3, which no triangle fits
[[nodiscard]] std::vector<std::vector<std::uint32_t>> split_spatially(
    const Mesh& mesh, std::span<const std::uint32_t> triangles, std::size_t most);

/// The vertices of some triangles of a mesh, each once, in ascending order.
[[nodiscard]] std::vector<std::uint32_t> vertices_of(const Mesh& mesh,
                                                     std::span<const std::uint32_t> triangles);

}  // namespace frangia
