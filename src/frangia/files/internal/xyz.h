#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A cloud as text: x y z on each line, and nx ny nz when there are six columns of which the last
/// three are unit vectors. Further columns and lines that begin with # or // are skipped.
///
/// shape    points without triangles
/// units    as in the file, taken for mm
/// errors   Error(Input) that names the file and the line: what is no number, fewer than three of
///          them, a place that is not finite
[[nodiscard]] Mesh read_xyz(const std::filesystem::path& path);

/// A line for each vertex: x y z, and nx ny nz when the mesh has normals; the shortest digits that
/// read back as the same numbers.
///
/// units    mm
/// missing  triangles, sigma_mm, views and marks have no place
/// errors   Error(Input) when the mesh is not whole; Error(File) when it cannot be written
void write_xyz(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
