#pragma once

#include <string_view>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Prepares a mesh for an operation that needs manifold edges: make_manifold splits edges of more
/// than two triangles, with a warning that names `operation`. Other meshes stay as they are.
///
/// @errors   Error(Input) that names `orient` for edges whose two triangles have opposite
///           orientation; Error(Cancelled)
[[nodiscard]] Mesh with_manifold_edges(Mesh mesh, std::string_view operation, const Run& run);

}  // namespace frangia
