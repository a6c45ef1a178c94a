#pragma once

#include <cstddef>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Drops connected parts of fewer triangles than `min_triangles`, in place.
void remove_small_components(Mesh& mesh, std::size_t min_triangles);

/// Gives each fan of triangles a vertex of its own where several meet in one vertex only.
void split_nonmanifold_vertices(Mesh& mesh);

/// All of that, and drops what vertices it leaves unused.
void clean_mesh(Mesh& mesh, std::size_t min_triangles);

/// Drops vertices without a triangle; the others keep their order.
void remove_unused_vertices(Mesh& mesh);

}  // namespace frangia
