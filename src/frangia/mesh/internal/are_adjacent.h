#pragma once

#include <algorithm>
#include <cstdint>

#include "frangia/geometry/connectivity.h"

namespace frangia {

/// Whether a triangle of the mesh has an edge between two vertices.
[[nodiscard]] inline bool are_adjacent(const Mesh& mesh,
                                       const HalfEdges& edges,
                                       std::uint32_t a,
                                       std::uint32_t b) {
  const auto outgoing = edges.outgoing(a);
  return std::any_of(outgoing.begin(), outgoing.end(), [&](std::uint32_t edge) {
    return target_vertex(mesh, edge) == b || opposite_vertex(mesh, edge) == b;
  });
}

}  // namespace frangia
