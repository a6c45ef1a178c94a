#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Checks the consistency of a mesh after reading or before writing.
///
/// @errors   Error(Input) that names the file and the element: a vertex or normal that is not
///          finite, a vertex farther than 1e15 mm from the origin, a triangle with a vertex index
///          out of range, or normals, sigma, views or marks whose number differs from that of the
///          vertices or triangles
void check_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// As check_mesh, for a format that cannot store points alone.
///
/// @errors   Error(Input) also when the mesh has no triangle
void check_triangles(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace frangia
