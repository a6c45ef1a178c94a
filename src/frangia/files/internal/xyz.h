#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a point cloud as text: x y z per line, separated by blanks, commas or semicolons. Columns
/// 4 to 6, and 7 to 9, are normals where they form unit vectors on every line, colours where they
/// are whole numbers to 255 or numbers to 1; others are left out with a warning. Lines that begin
/// with # or // are skipped, and so are names of the columns and a number of points in front of
/// them.
///
/// @shape    points without triangles
/// @units    as in the file, assumed to be mm
/// @errors   Error(Input) that names the file and the line: an invalid number, a decimal comma,
///          fewer than three numbers, another number of points than stated, a coordinate that is
///          not finite
[[nodiscard]] Mesh read_xyz(const std::filesystem::path& path, const Run& run = {});

/// Writes one line per vertex: x y z, and nx ny nz when the mesh has normals, with the shortest
/// digits that read back to the same numbers.
///
/// @units    mm
/// @missing  triangles, sigma, views and marks are not stored
/// @errors   Error(Input) when check_mesh fails; Error(File) when the file cannot be written
void write_xyz(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
