#pragma once

#include <cstddef>

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

}  // namespace frangia
