#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// What must hold of a mesh on its way out of or into a file.
///
/// errors   Error(Input) that names the file and the place: a vertex or normal that is not finite,
///          a triangle that refers to a vertex that is not there, normals, sigma or views that are
///          not one a vertex
void check_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// The same, for a format that holds triangles only.
///
/// errors   Error(Input) also when there is no triangle
void check_triangles(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace frangia
