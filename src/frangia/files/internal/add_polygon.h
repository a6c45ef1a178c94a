#pragma once

#include <span>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Adds a polygon as a fan of triangles around its first corner. Exact for convex polygons.
inline void add_polygon(Mesh& mesh, std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace frangia
