#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Removes connected components of fewer than `min_triangles` triangles, in place.
void remove_small_components(Mesh& mesh, std::size_t min_triangles);

/// Duplicates each vertex at which several fans of triangles meet, so that each fan has its own.
void split_nonmanifold_vertices(Mesh& mesh);

/// Removes small components, splits non-manifold vertices and removes unused vertices.
void clean_mesh(Mesh& mesh, std::size_t min_triangles);

/// Removes vertices without a triangle. The others keep their order.
void remove_unused_vertices(Mesh& mesh);

/// Finds the triangles whose corners are at the same three positions as those of an earlier
/// triangle, in any order.
///
/// @shape    indices of triangles, ascending
/// @missing  positions that are not finite are never the same
/// @errors   a vertex index out of range is a precondition violation
[[nodiscard]] std::vector<std::uint32_t> repeated_triangles(const Mesh& mesh);

}  // namespace frangia
