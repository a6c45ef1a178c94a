#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a point cloud as text: x y z per line, followed by nx ny nz when every line has six
/// columns and the last three form unit vectors. Further columns and lines that begin with # or //
/// are skipped.
///
/// @shape    points without triangles
/// @units    as in the file, assumed to be mm
/// @errors   Error(Input) that names the file and the line: an invalid number, fewer than three
///          numbers, a coordinate that is not finite
[[nodiscard]] Mesh read_xyz(const std::filesystem::path& path);

/// Writes one line per vertex: x y z, and nx ny nz when the mesh has normals, with the shortest
/// digits that read back to the same numbers.
///
/// @units    mm
/// @missing  triangles, sigma, views and marks are not stored
/// @errors   Error(Input) when check_mesh fails; Error(File) when the file cannot be written
void write_xyz(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
