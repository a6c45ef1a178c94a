#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Joins the triangles of a soup: a mesh in which most edges have a single triangle, since each
/// triangle or face has vertices of its own. Of other meshes, edges with a single triangle are
/// joined: programs write a vertex twice where normals or texture coordinates differ, and a closed
/// part then falls into pieces.
///
/// Two triangles are joined at an edge that both have at the same positions and in opposite
/// directions. Where more than two meet at an edge, those are joined that enclose material between
/// them, so that closed bodies that touch stay apart. Vertices with different colors, sigma, views
/// or marks are not joined. Normals are left out where vertices with different ones are joined. A
/// warning says what was joined.
///
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh join_soup(Mesh mesh, const std::filesystem::path& path, const Run& run);

}  // namespace frangia
